// Lines, words and numbers of text, the same in every locale.
#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace patchlab {

// Walks over the lines of a text, ended by LF or CRLF; counts them from 1.
class LineReader {
 public:
  explicit LineReader(std::string_view text, std::size_t first_number = 1)
      : rest_(text), number_(first_number - 1) {}

  // The next line without its end; nothing at the end of the text.
  std::optional<std::string_view> next();
  std::size_t number() const { return number_; }   // of the line that next() gave last
  std::string_view rest() const { return rest_; }  // what follows that line

 private:
  std::string_view rest_;
  std::size_t number_;
};

// Takes the next word (spaces and tabs separate words); empty when there is none.
std::string_view next_word(std::string_view& rest);
// The text without spaces, tabs and line ends around it.
std::string_view trimmed(std::string_view text);
// A to Z as a to z, all else as it is.
std::string lower_case(std::string_view text);

// The whole text as a number: decimal or scientific, an optional sign, `nan` and `inf` for floating point.
// Nothing where any character is left over or the number does not fit the type.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace patchlab
