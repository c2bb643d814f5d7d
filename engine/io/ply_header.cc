#include "engine/io/ply_header.h"

#include <algorithm>
#include <numeric>

#include "engine/io/read_error.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t longest_ply_header = 64 << 10;
constexpr std::size_t longest_ply_line = 4 << 10;

struct PlyType {
  std::string_view name;
  Scalar type;
};
constexpr PlyType ply_types[] = {
    {"char", Scalar::int8},       {"int8", Scalar::int8},       {"uchar", Scalar::uint8},
    {"uint8", Scalar::uint8},     {"short", Scalar::int16},     {"int16", Scalar::int16},
    {"ushort", Scalar::uint16},   {"uint16", Scalar::uint16},   {"int", Scalar::int32},
    {"int32", Scalar::int32},     {"uint", Scalar::uint32},     {"uint32", Scalar::uint32},
    {"float", Scalar::float32},   {"float32", Scalar::float32}, {"double", Scalar::float64},
    {"float64", Scalar::float64},
};
constexpr std::string_view ply_encodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};

std::optional<Scalar> type_named(std::string_view name) {
  const auto* const row = std::ranges::find(ply_types, name, &PlyType::name);
  if (row == std::end(ply_types)) return std::nullopt;
  return row->type;
}

using Words = std::vector<std::string_view>;

Words words_of(std::string_view line) {
  Words words;
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) words.push_back(word);
  return words;
}

// What a line does to the header; an error is the rest of a sentence about the line, empty where all is well.
std::string take_format(const Words& words, PlyHeader& header) {
  if (words.size() != 3 || words[2] != "1.0" || std::ranges::count(ply_encodings, words[1]) != 1) {
    return "the format must be ascii, binary_little_endian or binary_big_endian, of version 1.0.";
  }
  if (!header.encoding.empty()) return "the format is given twice.";
  header.encoding = words[1];
  return {};
}

std::string take_element(const Words& words, PlyHeader& header) {
  const auto count = words.size() == 3 ? parse_number<std::uint32_t>(words[2]) : std::nullopt;
  if (!count) return "an element needs a name and a whole number from 0 to 4294967295.";
  if (std::ranges::count(header.elements, words[1], &PlyElement::name) > 0) {
    return "element " + shown(words[1]) + " is declared twice.";
  }
  header.elements.push_back({std::string(words[1]), *count, {}});
  return {};
}

std::string take_property(const Words& words, PlyHeader& header) {
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3) return "a property needs a type and a name, a list two types and a name.";
  if (header.elements.empty()) return "a property stands before the first element.";
  const std::string_view type_name = words[words.size() - 2], property_name = words.back();
  const auto type = type_named(type_name);
  const auto size_type = list ? type_named(words[2]) : std::nullopt;
  if (!type || (list && !size_type)) return shown(type ? words[2] : type_name) + " is not a type of PLY.";
  if (size_type == Scalar::float32 || size_type == Scalar::float64)
    return "the length of a list must be a whole number.";
  std::vector<PlyProperty>& properties = header.elements.back().properties;
  if (std::ranges::count(properties, property_name, &PlyProperty::name) > 0) {
    return "property " + shown(property_name) + " is declared twice.";
  }
  properties.push_back({std::string(property_name), *type, size_type});
  return {};
}

std::string ignore(const Words&, PlyHeader&) { return {}; }

struct EntryRow {
  std::string_view keyword;
  std::string (*take)(const Words& words, PlyHeader& header);
};
constexpr EntryRow entries[] = {{"format", take_format},
                                {"element", take_element},
                                {"property", take_property},
                                {"comment", ignore},
                                {"obj_info", ignore}};

Result<void> check_whole(const PlyHeader& header, const std::string& name) {
  if (header.encoding.empty()) return unreadable(name, "the PLY header has no format line.");
  for (const PlyElement& element : header.elements) {
    if (element.count > 0 && element.properties.empty()) {
      return unreadable(name, "element " + shown(element.name) + " of the PLY header has no properties.");
    }
  }
  return {};
}

}  // namespace

bool PlyElement::has_list() const {
  return std::ranges::any_of(properties,
                             [](const PlyProperty& property) { return property.list_size.has_value(); });
}

std::size_t PlyElement::smallest_bytes() const {
  return std::accumulate(properties.begin(), properties.end(), std::size_t{0},
                         [](std::size_t sum, const PlyProperty& property) {
                           return sum + size_of(property.list_size.value_or(property.type));
                         });
}

Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name) {
  PlyHeader header;
  LineReader lines(bytes);
  while (const auto line = lines.next()) {
    header.data_begin = bytes.size() - lines.rest().size();
    if (line->size() > longest_ply_line || header.data_begin > longest_ply_header) {
      return unreadable_line(name, lines.number(),
                             "the PLY header is too long; it must stay below 64 KB, a line below 4 KB.");
    }
    const Words words = words_of(*line);
    if (words.empty() || (lines.number() == 1 && words[0] == "ply")) continue;
    if (words[0] == "end_header") {
      header.data_line = lines.number() + 1;
      if (const Result<void> whole = check_whole(header, name); !whole) return whole.error();
      return header;
    }
    const auto* const entry = std::ranges::find(entries, words[0], &EntryRow::keyword);
    if (entry == std::end(entries)) {
      return unreadable_line(name, lines.number(), shown(words[0]) + " is not an entry of a PLY header.");
    }
    if (const std::string fault = entry->take(words, header); !fault.empty()) {
      return unreadable_line(name, lines.number(), fault);
    }
  }
  return unreadable(name, "the PLY header ends without end_header; the file is cut off.");
}

}  // namespace patchlab
