// Text of a file or a library within a message.
#pragma once

#include <algorithm>
#include <string>

namespace patchlab {

// With ? for control characters, which would move a terminal's cursor or worse.
inline std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; }, '?');
  return text;
}

}  // namespace patchlab
