#include "engine/io/scan_size.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "engine/io/pcd_header.h"
#include "engine/io/ply_header.h"
#include "engine/io/recognise.h"
#include "engine/io/scan_from_columns.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_head = 64 << 10;
constexpr std::uint64_t double_vector_bytes = 24;  // of a row of text as numbers

struct Head {
  std::string_view bytes;
  std::uint64_t file_bytes;
};

std::optional<ScanSize> size_of(const Head& head, std::uint64_t points, std::uint64_t bytes_a_point) {
  constexpr std::uint64_t most_points_a_byte = 100;  // compressed; more is a damaged header
  if (points > head.file_bytes * most_points_a_byte) return std::nullopt;
  return ScanSize{points, head.file_bytes + points * bytes_a_point, true};
}

std::optional<ScanSize> size_of_pcd(const Head& head) {
  const Result<PcdHeader> header = parse_pcd_header(head.bytes, {});
  if (!header) return std::nullopt;
  std::vector<Column> columns;
  for (const PcdField& field : header->fields) columns.push_back({field.name, field.type, field.count});
  const bool in_place = header->encoding == "binary";
  return size_of(head, header->points, memory_of_point(columns) + (in_place ? 0 : header->point_bytes()));
}

std::optional<ScanSize> size_of_ply(const Head& head) {
  const Result<PlyHeader> header = parse_ply_header(head.bytes, {});
  if (!header) return std::nullopt;
  const auto vertex = std::ranges::find(header->elements, "vertex", &PlyElement::name);
  if (vertex == header->elements.end()) return std::nullopt;
  std::vector<Column> columns;
  for (const PlyProperty& property : vertex->properties) columns.push_back({property.name, property.type});
  const bool in_place = header->encoding != "ascii" && !vertex->has_list();
  return size_of(head, vertex->count, memory_of_point(columns) + (in_place ? 0 : vertex->smallest_bytes()));
}

std::optional<ScanSize> size_of_kitti(const Head& head) {
  return size_of(head, head.file_bytes / (4 * sizeof(float)), memory_of_point({}));
}

std::optional<ScanSize> size_of_text(const Head& head) {
  const auto lines = static_cast<std::uint64_t>(std::ranges::count(head.bytes, '\n'));
  auto size =
      size_of(head, head.file_bytes * lines / head.bytes.size(), memory_of_point({}) + double_vector_bytes);
  if (size) size->exact = false;
  return size;
}

struct FormatRow {
  ScanReader reader;
  std::optional<ScanSize> (*size)(const Head& head);
};
constexpr FormatRow format_rows[] = {{read_pcd, size_of_pcd},          {read_ply, size_of_ply},
                                     {read_kitti, size_of_kitti},      {read_obj, size_of_text},
                                     {read_point_table, size_of_text}, {read_off, size_of_text}};

}  // namespace

std::optional<ScanSize> foresee_scan(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  const std::uint64_t file_bytes = fs::file_size(file, failed);
  std::ifstream in(file, std::ios::binary);
  std::string head(std::min<std::uint64_t>(failed ? 0 : file_bytes, longest_head), '\0');
  if (head.empty() || !in.read(head.data(), static_cast<std::streamsize>(head.size()))) return std::nullopt;
  const auto* const row =
      std::ranges::find(format_rows, scan_reader(head, file.string()), &FormatRow::reader);
  return row == std::end(format_rows) ? std::nullopt : row->size({head, file_bytes});
}

}  // namespace patchlab
