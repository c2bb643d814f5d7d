#include "engine/cli/region_file.h"

#include <charconv>
#include <limits>

#include "engine/io/json.h"
#include "engine/io/read_error.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

using Ids = std::vector<std::uint32_t>;

Result<Ids> ids_from_json(std::string_view text, const std::string& name) {
  const Result<nlohmann::json> json = parse_json(text, name);
  if (!json) return json.error();
  std::optional<Error> error;
  const JsonPlace place(*json, name, error);
  place.only({"indices"});
  Ids ids;
  for (const JsonPlace& item : place["indices"].items()) {
    ids.push_back(static_cast<std::uint32_t>(item.whole_number(std::numeric_limits<std::uint32_t>::max())));
  }
  if (error) return *error;
  return ids;
}

}  // namespace

Result<Ids> parse_region(std::string_view text, const std::string& name) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '{') return ids_from_json(text, name);
  Ids ids;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text = end == std::string_view::npos ? "" : text.substr(end + 1);
    if (line.empty()) continue;
    std::uint32_t id = 0;
    const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), id);
    if (error != std::errc() || rest != line.data() + line.size()) {
      return unreadable_line(name, number,
                             shown(line) +
                                 " is no point index; write one a line, counted from 0, or JSON "
                                 "{\"indices\": [...]}.");
    }
    ids.push_back(id);
  }
  return ids;
}

}  // namespace patchlab
