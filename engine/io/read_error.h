// How the readers word what is wrong with a file, and what they left out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/printable.h"
#include "engine/base/result.h"

namespace patchlab {

inline Error unreadable(const std::string& name, const std::string& what) {
  return {ErrorCode::unreadable, name + ": " + what};
}
inline Error unreadable_line(const std::string& name, std::size_t line, const std::string& what) {
  return unreadable(name, "line " + std::to_string(line) + ": " + what);
}

// Text of a file within a message: in quotes, cut short, without control characters.
inline std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "'" + printable(std::string(text.substr(0, longest))) + (text.size() > longest ? "...'" : "'");
}

// How notices end that say why no viewpoint was found.
inline constexpr std::string_view at_the_origin =
    ": the sensor is taken to be at the origin, looking along +z.";

// What of a file follows its last point; some writers fill it up with zeros.
inline void note_rest(std::string_view rest, std::vector<std::string>& notices) {
  if (rest.empty()) return;
  const bool padding = rest.find_first_not_of('\0') == std::string_view::npos;
  notices.push_back(std::to_string(rest.size()) + (padding ? " zero bytes (padding)" : " bytes") +
                    " after the last point were left out.");
}

}  // namespace patchlab
