// How the readers word what is wrong with a file.
#pragma once

#include <string>

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
  std::string quoted = "'";
  for (const char c : text.substr(0, longest)) quoted += (c >= ' ' && c != '\x7f') || c < '\0' ? c : '?';
  return quoted + (text.size() > longest ? "...'" : "'");
}

}  // namespace patchlab
