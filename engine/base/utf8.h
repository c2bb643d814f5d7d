// Whether bytes are text.
#pragma once

#include <iterator>
#include <string_view>

namespace patchlab {

// The first byte that is no part of well-formed UTF-8 (RFC 3629), or npos.
inline std::size_t first_not_utf8(std::string_view text) {
  struct Form {
    unsigned char mask, lead;
    std::size_t length;
    char32_t least;
  };
  constexpr Form forms[] = {
      {0x80, 0x00, 1, 0}, {0xe0, 0xc0, 2, 0x80}, {0xf0, 0xe0, 3, 0x800}, {0xf8, 0xf0, 4, 0x10000}};
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
    const Form* form = forms;
    while (form != std::end(forms) && (byte(0) & form->mask) != form->lead) ++form;
    if (form == std::end(forms) || at + form->length > text.size()) return at;
    char32_t code = byte(0) & static_cast<unsigned char>(~form->mask);
    for (std::size_t i = 1; i < form->length; ++i) {
      if ((byte(i) & 0xc0) != 0x80) return at;
      code = code << 6 | (byte(i) & 0x3f);
    }
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    if (code < form->least || code > 0x10ffff || is_surrogate) return at;
    at += form->length;
  }
  return std::string_view::npos;
}

}  // namespace patchlab
