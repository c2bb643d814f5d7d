#include <algorithm>
#include <cstring>

#include "engine/io/lzf.h"
#include "engine/io/pcd_header.h"
#include "engine/io/read_error.h"
#include "engine/io/read_scan.h"
#include "engine/io/scan_from_columns.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t lines_between_progress = 1 << 16;

// The points as columns, and the memory they lie in where it is not the file's own.
struct Body {
  std::vector<char> memory;
  std::vector<Column> columns;
};

struct Source {
  std::string_view data;  // what follows the header
  const PcdHeader& header;
  const std::string& name;
  const ReadOptions& options;
  std::vector<std::string>& notices;
};

// Of no points there is no memory to point into.
const char* behind(const char* first, std::size_t bytes) { return first ? first + bytes : nullptr; }

std::vector<Column> interleaved(const std::vector<PcdField>& fields, const char* first) {
  std::size_t step = 0;
  for (const PcdField& field : fields) step += field.bytes();
  std::vector<Column> columns;
  for (const PcdField& field : fields) {
    columns.push_back({field.name, field.type, field.count, first, step});
    first = behind(first, field.bytes());
  }
  return columns;
}

std::vector<Column> one_after_another(const std::vector<PcdField>& fields, std::size_t points,
                                      const char* first) {
  std::vector<Column> columns;
  for (const PcdField& field : fields) {
    columns.push_back({field.name, field.type, field.count, first, field.bytes()});
    first = behind(first, field.bytes() * points);
  }
  return columns;
}

Error too_short(const Source& source, std::uint64_t needed) {
  return unreadable(source.name, std::to_string(source.header.points) + " points need " +
                                     std::to_string(needed) + " bytes after the header, but only " +
                                     std::to_string(source.data.size()) +
                                     " follow; the file is cut off or its header is wrong.");
}

Result<Body> read_binary(const Source& source) {
  const std::uint64_t needed = source.header.points * source.header.point_bytes();
  if (source.data.size() < needed) return too_short(source, needed);
  if (const auto fits = check_memory(source.name, source.header.points, 0, source.options); !fits)
    return fits.error();
  note_rest(source.data.substr(needed), source.notices);
  return Body{{}, interleaved(source.header.fields, source.data.data())};
}

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return value;
}

Result<Body> read_compressed(const Source& source) {
  constexpr std::size_t sizes = 8;
  if (source.data.size() < sizes) {
    return unreadable(source.name, "ends where its compressed points should begin; the file is cut off.");
  }
  const std::uint64_t compressed = little_endian(source.data),
                      uncompressed = little_endian(source.data.substr(4));
  const std::uint64_t expected = source.header.points * source.header.point_bytes();
  if (uncompressed != expected) {
    return unreadable(source.name, "its compressed points claim " + std::to_string(uncompressed) +
                                       " bytes where the header needs " + std::to_string(expected) +
                                       "; the file is damaged.");
  }
  if (compressed > source.data.size() - sizes) return too_short(source, compressed + sizes);
  if (uncompressed > compressed * lzf_largest_expansion) {
    return unreadable(source.name, std::to_string(compressed) + " compressed bytes cannot hold " +
                                       std::to_string(uncompressed) + "; the file is damaged.");
  }
  if (const auto fits = check_memory(source.name, source.header.points, uncompressed, source.options);
      !fits) {
    return fits.error();
  }
  Body body{std::vector<char>(uncompressed), {}};
  if (!lzf_decompress(source.data.substr(sizes, compressed), body.memory)) {
    return unreadable(source.name, "its compressed points are damaged.");
  }
  note_rest(source.data.substr(compressed + sizes), source.notices);
  body.columns = one_after_another(source.header.fields, source.header.points, body.memory.data());
  return body;
}

// As declared, but for coordinates: their text may hold more digits than the float32 it is declared as.
std::vector<PcdField> fields_of_text(std::vector<PcdField> fields) {
  for (PcdField& field : fields) {
    const bool coordinate = field.name == "x" || field.name == "y" || field.name == "z";
    if (coordinate && field.type == Scalar::float32) field.type = Scalar::float64;
  }
  return fields;
}

// A line of text to one point; the words must be as many as the values.
Result<void> store_line(const Source& source, const std::vector<PcdField>& fields, std::string_view line,
                        std::size_t number, char* to) {
  std::string_view rest = line;
  std::size_t stored = 0;
  for (const PcdField& field : fields) {
    for (std::uint32_t element = 0; element < field.count; ++element, ++stored) {
      const std::string_view word = next_word(rest);
      if (word.empty()) {
        return unreadable_line(source.name, number,
                               "has " + std::to_string(stored) + " values where a point has " +
                                   std::to_string(source.header.point_values()) + ".");
      }
      if (!store_number(word, field.type, to)) {
        return unreadable_line(source.name, number,
                               shown(word) + " for field " + shown(field.name) + " is not a number of type " +
                                   std::string(name(field.type)) + ".");
      }
      to += size_of(field.type);
    }
  }
  if (trimmed(rest).empty()) return {};
  return unreadable_line(source.name, number,
                         "has more values than the " + std::to_string(stored) + " of a point.");
}

Result<Body> read_ascii(const Source& source) {
  const std::uint64_t points = source.header.points;
  const std::uint64_t needed =
      points * source.header.point_values() * 2 - 1;  // a digit and what separates it
  if (source.data.size() < needed) return too_short(source, needed);
  const std::vector<PcdField> fields = fields_of_text(source.header.fields);
  const std::vector<Column> layout = interleaved(fields, nullptr);
  const std::size_t step = layout.front().stride;
  if (const auto fits = check_memory(source.name, points, points * step, source.options); !fits)
    return fits.error();

  Body body{std::vector<char>(points * step), {}};
  body.columns = interleaved(fields, body.memory.data());
  LineReader lines(source.data, source.header.data_line);
  std::uint64_t stored = 0;
  while (const auto line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    if (stored == points) {
      note_rest(source.data.substr(static_cast<std::size_t>(line->data() - source.data.data())),
                source.notices);
      return body;
    }
    const auto read = store_line(source, fields, *line, lines.number(), body.memory.data() + stored * step);
    if (!read) return read.error();
    ++stored;
    if (stored % lines_between_progress == 0 &&
        !keep_going(source.options.progress, static_cast<double>(stored) / static_cast<double>(points))) {
      return Error{ErrorCode::cancelled, source.name + ": reading was cancelled."};
    }
  }
  if (stored == points) return body;
  return unreadable(source.name, "the header promises " + std::to_string(points) + " points, but " +
                                     std::to_string(stored) +
                                     " follow; the file is cut off or its header is wrong.");
}

Scan scan_of(const PcdHeader& header, const std::string& name) {
  Scan scan;
  scan.file = name;
  scan.format = "pcd";
  scan.encoding = header.encoding;
  scan.width = header.width;
  scan.height = header.height;
  scan.viewpoint = header.viewpoint;
  scan.notices = header.notices;
  for (const PcdField& field : header.fields) {
    scan.fields.push_back({field.name, std::string(patchlab::name(field.type)), field.count});
  }
  return scan;
}

struct EncodingRow {
  std::string_view name;
  Result<Body> (*read)(const Source& source);
};
constexpr EncodingRow encoding_rows[] = {
    {"ascii", read_ascii}, {"binary", read_binary}, {"binary_compressed", read_compressed}};

}  // namespace

Result<Scan> read_pcd(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const Result<PcdHeader> header = parse_pcd_header(bytes, name);
  if (!header) return header.error();
  Scan scan = scan_of(*header, name);
  const auto* const encoding = std::ranges::find(encoding_rows, header->encoding, &EncodingRow::name);
  const Result<Body> body =
      encoding->read({bytes.substr(header->data_begin), *header, name, options, scan.notices});
  if (!body) return body.error();
  const auto filled = fill_scan(scan, body->columns, header->points, OriginRule::where_large, options);
  if (!filled) return filled.error();
  return scan;
}

}  // namespace patchlab
