#include "engine/io/lzf.h"

#include <cstring>

namespace patchlab {
namespace {

constexpr std::size_t longest_literal = 32;
constexpr std::size_t length_in_next_byte = 7;
constexpr std::size_t shortest_match = 2;

// A match may overlap what it writes: the bytes from `from` on are repeated.
void copy_match(char* to, const char* from, std::size_t length) {
  if (static_cast<std::size_t>(to - from) >= length) {
    std::memcpy(to, from, length);
  } else {
    while (length-- > 0) *to++ = *from++;
  }
}

}  // namespace

bool lzf_decompress(std::string_view compressed, std::vector<char>& out) {
  const auto* in = reinterpret_cast<const unsigned char*>(compressed.data());
  const auto* const in_end = in + compressed.size();
  char* to = out.data();
  char* const to_end = to + out.size();
  const auto left = [](const auto* from, const auto* end) { return static_cast<std::size_t>(end - from); };

  while (in < in_end) {
    const std::size_t control = *in++;
    if (control < longest_literal) {
      const std::size_t length = control + 1;
      if (left(in, in_end) < length || left(to, to_end) < length) return false;
      std::memcpy(to, in, length);
      in += length;
      to += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == length_in_next_byte) {
      if (in == in_end) return false;
      length += *in++;
    }
    length += shortest_match;
    if (in == in_end) return false;
    const std::size_t distance = (((control & 31) << 8) | *in++) + 1;
    if (left(out.data(), to) < distance || left(to, to_end) < length) return false;
    copy_match(to, to - distance, length);
    to += length;
  }
  return to == to_end;
}

}  // namespace patchlab
