#include "engine/export/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace patchlab {

std::string decimal(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string decimals(const Eigen::Ref<const Eigen::VectorXd>& values, std::string_view between) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : std::string(between)) + decimal(value);
  return text;
}

std::string one_line(std::string_view text) {
  std::string line(text);
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return line;
}

std::string xml(std::string_view text) {
  std::string out;
  for (const char c : one_line(text)) {
    constexpr std::string_view special = "&<>\"'";
    constexpr std::string_view entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};
    const std::size_t at = special.find(c);
    at == std::string_view::npos ? out += c : out += entities[at];
  }
  return out;
}

std::string plain_name(std::string_view text, std::size_t number) {
  std::string name = "p" + std::to_string(number) + "_";
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name.substr(0, 80);
}

Result<std::string> common_frame(const PatchSet& set, std::string_view format) {
  std::string frame = set.patches.empty() ? "" : set.patches.front().frame_id;
  for (const PatchRecord& record : set.patches) {
    if (record.frame_id == frame) continue;
    return Error{ErrorCode::refused,
                 "patch \"" + record.id + "\": stands in the frame \"" + record.frame_id + "\", not in \"" +
                     frame + "\" as others do, and " + std::string(format) +
                     " holds one frame; choose the patches of one frame. Nothing was written."};
  }
  return frame;
}

}  // namespace patchlab
