#include "engine/io/pcd_header.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "engine/io/read_error.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t longest_pcd_header = 64 << 10;
constexpr std::size_t longest_pcd_line = 4 << 10;
constexpr std::size_t largest_point = 4 << 10;  // bytes
constexpr double quaternion_tolerance = 1e-3;

struct Entry {
  std::string_view keyword;
  std::vector<std::string_view> words;
  std::size_t line = 0;  // 0: the header has no such entry
};

struct PcdType {
  std::string_view letter, size;
  Scalar type;
};
constexpr PcdType pcd_types[] = {
    {"I", "1", Scalar::int8},    {"U", "1", Scalar::uint8},  {"I", "2", Scalar::int16},
    {"U", "2", Scalar::uint16},  {"I", "4", Scalar::int32},  {"U", "4", Scalar::uint32},
    {"I", "8", Scalar::int64},   {"U", "8", Scalar::uint64}, {"F", "4", Scalar::float32},
    {"F", "8", Scalar::float64},
};

constexpr std::string_view pcd_encodings[] = {"ascii", "binary", "binary_compressed"};

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Result<PcdHeader> parse() {
    for (const auto step :
         {&HeaderParser::collect_entries, &HeaderParser::check_version, &HeaderParser::parse_fields,
          &HeaderParser::parse_counts, &HeaderParser::check_point, &HeaderParser::parse_size,
          &HeaderParser::parse_viewpoint}) {
      if (const Result<void> done = (this->*step)(); !done) return done.error();
    }
    return std::move(header_);
  }

 private:
  Error wrong(const Entry& entry, const std::string& what) const {
    return unreadable_line(name_, entry.line, what);
  }

  Result<void> collect_entries();
  Result<void> take_entry(std::string_view line, std::size_t number);
  Result<void> take_data(std::string_view line, const LineReader& lines);
  Result<void> check_version();
  Result<void> parse_fields();
  Result<void> parse_counts();
  Result<void> check_point();
  Result<void> parse_size();
  Result<void> parse_viewpoint();
  Result<std::uint64_t> whole_number(const Entry& entry) const;
  Result<void> same_length(const Entry& entry) const;

  std::string_view bytes_;
  const std::string& name_;
  PcdHeader header_;
  Entry version_{"VERSION", {}}, fields_{"FIELDS", {}}, sizes_{"SIZE", {}}, types_{"TYPE", {}},
      counts_{"COUNT", {}}, width_{"WIDTH", {}}, height_{"HEIGHT", {}}, points_{"POINTS", {}},
      viewpoint_{"VIEWPOINT", {}};
};

Result<void> HeaderParser::collect_entries() {
  LineReader lines(bytes_);
  while (const auto line = lines.next()) {
    const std::size_t used = bytes_.size() - lines.rest().size();
    if (line->size() > longest_pcd_line || used > longest_pcd_header) {
      return unreadable_line(name_, lines.number(),
                             "the PCD header is too long; it must stay below 64 KB, a line below 4 KB.");
    }
    const std::string_view text = trimmed(*line);
    if (text.find('\r') != std::string_view::npos) {
      return unreadable_line(name_, lines.number(),
                             "lines end with a carriage return alone; convert the line ends to LF.");
    }
    if (text.empty() || text.front() == '#') continue;
    if (text.starts_with("DATA")) return take_data(text, lines);
    if (const Result<void> taken = take_entry(text, lines.number()); !taken) return taken;
  }
  return unreadable(name_, "the PCD header ends without a DATA line; the file is cut off.");
}

Result<void> HeaderParser::take_entry(std::string_view line, std::size_t number) {
  std::string_view keyword = next_word(line);
  if (keyword == "COLUMNS") keyword = "FIELDS";
  Entry* const known[] = {&version_, &fields_, &sizes_,  &types_,    &counts_,
                          &width_,   &height_, &points_, &viewpoint_};
  const auto* const found = std::ranges::find(known, keyword, &Entry::keyword);
  if (found == std::end(known)) {
    return unreadable_line(name_, number, shown(keyword) + " is not an entry of a PCD header.");
  }
  Entry& entry = **found;
  if (entry.line != 0) {
    return unreadable_line(
        name_, number, std::string(keyword) + " stands in line " + std::to_string(entry.line) + " already.");
  }
  entry.line = number;
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line))
    entry.words.push_back(word);
  return {};
}

// Some writers forget to end this line: the first point then follows `ascii` at once.
Result<void> HeaderParser::take_data(std::string_view line, const LineReader& lines) {
  line.remove_prefix(std::string_view("DATA").size());
  std::string_view word = next_word(line);
  header_.data_begin = bytes_.size() - lines.rest().size();
  header_.data_line = lines.number() + 1;
  header_.encoding = lower_case(word);
  if (std::ranges::count(pcd_encodings, header_.encoding) == 1 && line.empty()) return {};
  if (!lower_case(word).starts_with("ascii")) {
    return unreadable_line(name_, lines.number(),
                           "DATA must be ascii, binary or binary_compressed, not " +
                               shown(trimmed(std::string(word) + std::string(line))) + ".");
  }
  header_.encoding = "ascii";
  header_.data_begin =
      static_cast<std::size_t>(word.data() - bytes_.data()) + std::string_view("ascii").size();
  header_.data_line = lines.number();
  header_.notices.push_back("The first point stands on the DATA line of the header; it was read from there.");
  return {};
}

Result<void> HeaderParser::check_version() {
  constexpr std::string_view known[] = {".5", "0.5", ".6", "0.6", ".7", "0.7"};
  if (version_.line == 0) return {};
  if (version_.words.size() == 1 && std::ranges::count(known, version_.words[0]) == 1) return {};
  return wrong(version_, "the PCD version must be .5, .6 or .7, not " +
                             (version_.words.empty() ? std::string("empty") : shown(version_.words[0])) +
                             ".");
}

Result<void> HeaderParser::same_length(const Entry& entry) const {
  if (entry.line == 0)
    return unreadable(name_, "the PCD header has no " + std::string(entry.keyword) + " line.");
  if (entry.words.size() == fields_.words.size()) return {};
  return wrong(entry, std::string(entry.keyword) + " has " + std::to_string(entry.words.size()) +
                          " entries where FIELDS has " + std::to_string(fields_.words.size()) + ".");
}

Result<void> HeaderParser::parse_fields() {
  for (const Entry* entry : {&fields_, &sizes_, &types_}) {
    if (const Result<void> same = same_length(*entry); !same) return same;
  }
  for (std::size_t i = 0; i < fields_.words.size(); ++i) {
    const std::string_view field = fields_.words[i], letter = types_.words[i], size = sizes_.words[i];
    const auto* const row = std::ranges::find_if(
        pcd_types, [&](const PcdType& type) { return type.letter == letter && type.size == size; });
    if (row == std::end(pcd_types)) {
      return wrong(types_, "field " + shown(field) + " has TYPE " + shown(letter) + " and SIZE " +
                               shown(size) + "; known are I and U of 1, 2, 4 or 8 bytes and F of 4 or 8.");
    }
    if (field != "_" && std::ranges::count(fields_.words, field) > 1) {
      return wrong(fields_, "field " + shown(field) + " is named twice.");
    }
    header_.fields.push_back({std::string(field), row->type, 1});
  }
  return {};
}

Result<void> HeaderParser::parse_counts() {
  if (counts_.line == 0) return {};
  if (const Result<void> same = same_length(counts_); !same) return same;
  for (std::size_t i = 0; i < header_.fields.size(); ++i) {
    const auto count = parse_number<std::uint32_t>(counts_.words[i]);
    if (!count || *count > largest_point) {
      return wrong(counts_, "COUNT of field " + shown(header_.fields[i].name) +
                                " must be a whole number up to 4096, not " + shown(counts_.words[i]) + ".");
    }
    header_.fields[i].count = *count;
  }
  return {};
}

Result<void> HeaderParser::check_point() {
  if (header_.point_bytes() > largest_point) return wrong(fields_, "a point takes more than 4096 bytes.");
  return {};
}

Result<std::uint64_t> HeaderParser::whole_number(const Entry& entry) const {
  const std::optional<std::uint32_t> number =
      entry.words.size() == 1 ? parse_number<std::uint32_t>(entry.words[0]) : std::nullopt;
  if (!number || *number == 0) {
    return wrong(entry, std::string(entry.keyword) + " must be one whole number from 1 to 4294967295" +
                            (entry.words.size() == 1 ? ", not " + shown(entry.words[0]) : "") + ".");
  }
  return std::uint64_t{*number};
}

Result<void> HeaderParser::parse_size() {
  if (points_.line == 0) return unreadable(name_, "the PCD header has no POINTS line.");
  if (width_.line == 0 && height_.line != 0) return unreadable(name_, "the PCD header has no WIDTH line.");
  const Result<std::uint64_t> points = whole_number(points_);
  if (!points) return points.error();
  const Result<std::uint64_t> width = width_.line != 0 ? whole_number(width_) : points;
  if (!width) return width.error();
  const Result<std::uint64_t> height = height_.line != 0 ? whole_number(height_) : std::uint64_t{1};
  if (!height) return height.error();
  if (*width * *height != *points) {
    return wrong(points_, "POINTS " + std::to_string(*points) + " is not WIDTH x HEIGHT, " +
                              std::to_string(*width) + " x " + std::to_string(*height) + ".");
  }
  if (height_.line == 0) {
    header_.notices.push_back("The header has no HEIGHT line: the points are taken as not organised.");
  }
  header_.points = *points;
  header_.width = static_cast<std::uint32_t>(*width);
  header_.height = static_cast<std::uint32_t>(*height);
  return {};
}

// VIEWPOINT tx ty tz qw qx qy qz: the real part of the quaternion comes first.
Result<void> HeaderParser::parse_viewpoint() {
  const std::string assumed(at_the_origin);
  std::vector<double> numbers;
  for (const std::string_view word : viewpoint_.words) {
    const auto number = parse_number<double>(word);
    if (number && std::isfinite(*number)) numbers.push_back(*number);
  }
  if (viewpoint_.line == 0) {
    header_.notices.push_back("The file states no viewpoint" + assumed);
    return {};
  }
  const bool seven = numbers.size() == 7 && viewpoint_.words.size() == 7;
  const double norm =
      seven ? std::hypot(std::hypot(numbers[3], numbers[4]), std::hypot(numbers[5], numbers[6])) : 0.0;
  if (std::abs(norm - 1.0) > quaternion_tolerance) {
    header_.notices.push_back("VIEWPOINT in line " + std::to_string(viewpoint_.line) +
                              " is not seven numbers with a unit quaternion" + assumed);
    return {};
  }
  Viewpoint& viewpoint = header_.viewpoint;
  viewpoint.position = {numbers[0], numbers[1], numbers[2]};
  viewpoint.quaternion_xyzw = {numbers[4], numbers[5], numbers[6], numbers[3]};
  const bool identity =
      viewpoint.position.isZero(0.0) && numbers[4] == 0.0 && numbers[5] == 0.0 && numbers[6] == 0.0;
  viewpoint.stated = !identity;
  if (identity)
    header_.notices.push_back("VIEWPOINT of the file is the identity, which says nothing" + assumed);
  return {};
}

}  // namespace

std::size_t PcdHeader::point_bytes() const {
  return std::accumulate(fields.begin(), fields.end(), std::size_t{0},
                         [](std::size_t sum, const PcdField& field) { return sum + field.bytes(); });
}

std::size_t PcdHeader::point_values() const {
  return std::accumulate(fields.begin(), fields.end(), std::size_t{0},
                         [](std::size_t sum, const PcdField& field) { return sum + field.count; });
}

Result<PcdHeader> parse_pcd_header(std::string_view bytes, const std::string& name) {
  return HeaderParser(bytes, name).parse();
}

}  // namespace patchlab
