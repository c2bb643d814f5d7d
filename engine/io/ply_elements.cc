#include "engine/io/ply_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/io/read_error.h"
#include "engine/io/scan_from_columns.h"

namespace patchlab {
namespace {

constexpr std::uint64_t records_between_progress = 1 << 16;
constexpr std::size_t largest_scalar = 8;

// As declared, but for coordinates in text: they may hold more digits than a float32.
Scalar stored_type(const PlyProperty& property, bool is_text) {
  const bool coordinate = property.name == "x" || property.name == "y" || property.name == "z";
  return is_text && coordinate && property.type == Scalar::float32 ? Scalar::float64 : property.type;
}

// The plain properties of the records, interleaved from `first` on.
std::vector<Column> interleaved(const PlyElement& element, bool is_text, const char* first) {
  std::vector<Column> columns;
  std::size_t step = 0;
  for (const PlyProperty& property : element.properties) {
    if (property.list_size) continue;
    const Scalar type = stored_type(property, is_text);
    columns.push_back({property.name, type, 1, first == nullptr ? nullptr : first + step, 0});
    step += size_of(type);
  }
  for (Column& column : columns) column.stride = step;
  return columns;
}

double number(Scalar type, const char* bytes) {
  double value = 0.0;
  gather({{}, type, 1, bytes, 0}, 1, 0, &value, 1);
  return value;
}

bool names_vertices(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

// Whether the list is a face: three entries or more, each the index of a vertex.
Result<bool> walk_list(PlyCursor& cursor, const PlyProperty& property, std::uint64_t vertices,
                       PlyFaces* faces) {
  std::array<char, largest_scalar> bytes;
  if (const Result<void> taken = cursor.take(property, *property.list_size, bytes.data()); !taken)
    return taken.error();
  const double size = number(*property.list_size, bytes.data());
  if (size < 0.0)
    return unreadable(cursor.name(), "a list " + shown(property.name) + " has a negative length.");
  bool face = size >= 3.0;
  for (double i = 0.0; i < size; ++i) {
    if (const Result<void> taken = cursor.take(property, property.type, bytes.data()); !taken)
      return taken.error();
    const double index = number(property.type, bytes.data());
    const bool there = index >= 0.0 && index < static_cast<double>(vertices);
    face = face && there;
    if (faces != nullptr) faces->corners.push_back(there ? static_cast<std::int64_t>(index) : -1);
  }
  if (faces != nullptr) faces->ends.push_back(faces->corners.size());
  return face;
}

// One record to the columns that lie at `to`.
Result<void> walk_record(PlyCursor& cursor, const PlyElement& element, std::uint64_t vertices, char* to,
                         PlyElementData& data, PlyFaces* faces) {
  if (const Result<void> begun = cursor.begin_record(); !begun) return begun;
  for (const PlyProperty& property : element.properties) {
    if (property.list_size) {
      const Result<bool> face =
          walk_list(cursor, property, vertices, names_vertices(property) ? faces : nullptr);
      if (!face) return face.error();
      if (!*face && names_vertices(property)) ++data.bad_faces;
      continue;
    }
    const Scalar type = stored_type(property, cursor.is_text());
    if (const Result<void> taken = cursor.take(property, type, to); !taken) return taken;
    to += size_of(type);
  }
  return cursor.end_record();
}

Result<PlyElementData> walk_records(PlyCursor& cursor, const PlyElement& element, std::uint64_t vertices,
                                    const ReadOptions& options, PlyFaces* faces) {
  const std::vector<Column> layout = interleaved(element, cursor.is_text(), nullptr);
  const std::size_t step = layout.empty() ? 0 : layout[0].stride;
  const std::uint64_t points = element.name == "vertex" ? element.count : 0;
  if (const auto fits = check_memory(cursor.name(), points, element.count * step, options); !fits) {
    return fits.error();
  }
  PlyElementData data;
  data.memory.resize(element.count * step);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    const auto walked = walk_record(cursor, element, vertices, data.memory.data() + i * step, data, faces);
    if (!walked) return walked.error();
    if (i % records_between_progress != records_between_progress - 1) continue;
    if (!keep_going(options.progress, static_cast<double>(i) / static_cast<double>(element.count))) {
      return Error{ErrorCode::cancelled, cursor.name() + ": reading was cancelled."};
    }
  }
  data.columns = interleaved(element, cursor.is_text(), data.memory.data());
  return data;
}

// Binary records of one size stay where they are.
Result<PlyElementData> columns_in_place(PlyCursor& cursor, const PlyElement& element) {
  PlyElementData data;
  data.columns = interleaved(element, false, cursor.rest().data());
  for (Column& column : data.columns) column.swapped = cursor.swapped();
  cursor.skip(element.count * element.smallest_bytes());
  return data;
}

}  // namespace

Result<void> PlyCursor::begin_record() {
  while (is_text_) {
    const auto line = lines_.next();
    if (!line) return cut_off();
    line_ = *line;
    if (!trimmed(line_).empty()) break;
  }
  return {};
}

Result<void> PlyCursor::take(const PlyProperty& property, Scalar type, char* to) {
  const std::size_t size = size_of(type);
  if (is_text_) {
    const std::string_view word = next_word(line_);
    if (!word.empty() && store_number(word, type, to)) return {};
    return unreadable_line(name_, lines_.number(),
                           word.empty()
                               ? "has no value for " + shown(property.name) + "."
                               : shown(word) + " for " + shown(property.name) + " is not a number of type " +
                                     std::string(patchlab::name(type)) + ".");
  }
  if (rest_.size() < size) return cut_off();
  std::memcpy(to, rest_.data(), size);
  if (swapped_) std::reverse(to, to + size);
  rest_.remove_prefix(size);
  return {};
}

Result<void> PlyCursor::end_record() const {
  if (!is_text_ || trimmed(line_).empty()) return {};
  return unreadable_line(name_, lines_.number(), "has more values than the header declares.");
}

Error PlyCursor::cut_off() const {
  return unreadable(name_,
                    "it ends before its last element does; the file is cut off or its header is wrong.");
}

Result<PlyElementData> read_ply_element(PlyCursor& cursor, const PlyElement& element, std::uint64_t vertices,
                                        const ReadOptions& options, PlyFaces* faces) {
  if (element.count == 0) return PlyElementData{};
  const std::uint64_t text_bytes = element.properties.size() * 2;  // a digit and what separates it
  const std::uint64_t least = element.count * (cursor.is_text() ? text_bytes : element.smallest_bytes());
  if (cursor.rest().size() + (cursor.is_text() ? 1 : 0) < least) {
    return unreadable(cursor.name(), std::to_string(element.count) + " records of " + shown(element.name) +
                                         " need at least " + std::to_string(least) + " bytes, but only " +
                                         std::to_string(cursor.rest().size()) +
                                         " follow; the file is cut off or its header is wrong.");
  }
  if (!cursor.is_text() && !element.has_list()) return columns_in_place(cursor, element);
  return walk_records(cursor, element, vertices, options, faces);
}

}  // namespace patchlab
