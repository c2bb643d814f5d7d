#include "engine/project/colour.h"

#include <charconv>
#include <cstdio>

namespace patchlab {

std::string to_text(const Colour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", unsigned{colour[0]}, unsigned{colour[1]},
                unsigned{colour[2]});
  return text;
}

std::optional<Colour> colour_from_text(const std::string& text) {
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  Colour colour;
  for (std::size_t k = 0; k < 3; ++k) {
    const char* const from = text.data() + 1 + 2 * k;
    if (std::from_chars(from, from + 2, colour[k], 16).ptr != from + 2) return std::nullopt;
  }
  return colour;
}

}  // namespace patchlab
