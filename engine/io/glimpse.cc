#include "engine/io/glimpse.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "engine/io/pcd_header.h"
#include "engine/io/ply_header.h"
#include "engine/io/recognise.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_beginning = 64 << 10;
constexpr std::uint64_t windows = 1000;  // the places of a file that are read

// Where the points lie in a file: records of the same size, or lines of text up to the end of the file.
struct Layout {
  std::size_t begin = 0;  // byte
  std::uint64_t records = 0;
  std::size_t record_bytes = 0;  // 0: lines
};

std::optional<Layout> layout_of_pcd(std::string_view head) {
  const Result<PcdHeader> header = parse_pcd_header(head, {});
  if (!header || header->encoding == "binary_compressed") return std::nullopt;
  if (header->encoding == "ascii") return Layout{header->data_begin};
  return Layout{header->data_begin, header->points, header->point_bytes()};
}

std::optional<Layout> layout_of_ply(std::string_view head) {
  const Result<PlyHeader> header = parse_ply_header(head, {});
  if (!header || header->elements.empty()) return std::nullopt;
  const PlyElement& first = header->elements.front();
  if (first.name != "vertex" || first.has_list()) return std::nullopt;
  if (header->encoding != "ascii") return Layout{header->data_begin, first.count, first.smallest_bytes()};
  return header->elements.size() == 1 ? std::optional(Layout{header->data_begin}) : std::nullopt;
}

// The first lines, a header row among them, stay as they are.
std::optional<Layout> layout_of_table(std::string_view head) {
  constexpr int first_lines = 10;
  LineReader lines(head);
  for (int i = 0; i < first_lines; ++i) {
    if (!lines.next()) return std::nullopt;
  }
  return Layout{head.size() - lines.rest().size()};
}

std::string head_of_pcd(std::string_view head, std::uint64_t points) {
  std::string text;
  LineReader lines(head);
  while (const auto line = lines.next()) {
    std::string_view rest = *line;
    const std::string_view key = next_word(rest);
    if (key == "WIDTH" || key == "POINTS")
      text.append(key).append(" ").append(std::to_string(points));
    else
      text.append(key == "HEIGHT" ? "HEIGHT 1" : *line);
    text += '\n';
  }
  return text;
}

std::string head_of_ply(std::string_view head, std::uint64_t points) {
  std::string text;
  LineReader lines(head);
  bool of_points = true;
  while (const auto line = lines.next()) {
    std::string_view rest = *line;
    const std::string_view key = next_word(rest), element = key == "element" ? next_word(rest) : "";
    if (key == "element") of_points = element == "vertex";
    if (key == "end_header") of_points = true;
    if (!of_points) continue;
    if (key == "element")
      text.append("element vertex ").append(std::to_string(points));
    else
      text.append(*line);
    text += '\n';
  }
  return text;
}

std::string head_of_table(std::string_view head, std::uint64_t) { return std::string(head); }

struct GlimpseRow {
  ScanReader reader;
  std::optional<Layout> (*layout)(std::string_view head);
  std::string (*head)(std::string_view head, std::uint64_t points);  // of so many points
};
constexpr GlimpseRow glimpse_rows[] = {{read_pcd, layout_of_pcd, head_of_pcd},
                                       {read_ply, layout_of_ply, head_of_ply},
                                       {read_point_table, layout_of_table, head_of_table}};

struct Some {
  std::string bytes;
  std::uint64_t points = 0;
};

// Adds the bytes from `begin` on; fewer at the end of the file.
void add(std::ifstream& in, std::uint64_t begin, std::uint64_t bytes, std::string& to) {
  const std::size_t before = to.size();
  to.resize(before + bytes);
  in.clear();
  in.seekg(static_cast<std::streamoff>(begin));
  in.read(to.data() + before, static_cast<std::streamsize>(bytes));
  to.resize(before + static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
}

std::optional<Some> some_records(std::ifstream& in, const Layout& layout, std::uint64_t file_bytes,
                                 std::uint64_t wanted) {
  const std::uint64_t each = std::max<std::uint64_t>(wanted / windows, 1);
  if (layout.record_bytes == 0 || layout.records < windows * each) return std::nullopt;
  if ((file_bytes - layout.begin) / layout.record_bytes < layout.records) return std::nullopt;
  Some some;
  for (std::uint64_t window = 0; window < windows; ++window) {
    const std::uint64_t first = (layout.records - each) / (windows - 1) * window;
    add(in, layout.begin + first * layout.record_bytes, each * layout.record_bytes, some.bytes);
  }
  some.points = some.bytes.size() / layout.record_bytes;
  return some;
}

// Whole lines alone: what a window cuts at its two ends is left out.
void add_lines(std::string_view window, std::string& to) {
  const std::size_t first = window.find('\n'), last = window.rfind('\n');
  if (first < last) to.append(window.substr(first + 1, last - first));
}

std::optional<Some> some_lines(std::ifstream& in, const Layout& layout, std::string_view head,
                               std::uint64_t file_bytes, std::uint64_t wanted) {
  const std::string_view lines = head.substr(layout.begin);
  const auto count = static_cast<std::uint64_t>(std::ranges::count(lines, '\n'));
  if (count == 0) return std::nullopt;
  const std::uint64_t bytes = (wanted / windows + 2) * (lines.size() / count);
  if (file_bytes - layout.begin < windows * bytes) return std::nullopt;
  Some some;
  std::string window;
  for (std::uint64_t i = 0; i < windows; ++i) {
    window.clear();
    add(in, layout.begin + (file_bytes - layout.begin - bytes) / windows * i, bytes, window);
    add_lines(window, some.bytes);
  }
  some.points = static_cast<std::uint64_t>(std::ranges::count(some.bytes, '\n'));
  return some;
}

}  // namespace

std::optional<Scan> glimpse_scan(const fs::path& file, const ReadOptions& options, const GlimpseSize& size) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  const std::uint64_t file_bytes = fs::file_size(file, failed);
  if (failed || file_bytes < std::max<std::uint64_t>(size.of_bytes, 1)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  std::string head;
  add(in, 0, std::min<std::uint64_t>(file_bytes, longest_beginning), head);
  const auto* const row =
      std::ranges::find(glimpse_rows, scan_reader(head, file.string()), &GlimpseRow::reader);
  if (row == std::end(glimpse_rows)) return std::nullopt;
  const std::optional<Layout> layout = row->layout(head);
  if (!layout) return std::nullopt;
  const std::optional<Some> some = layout->record_bytes > 0
                                       ? some_records(in, *layout, file_bytes, size.points)
                                       : some_lines(in, *layout, head, file_bytes, size.points);
  if (!some) return std::nullopt;
  ReadOptions quiet = options;
  quiet.progress = {};
  const std::string bytes =
      row->head(std::string_view(head).substr(0, layout->begin), some->points) + some->bytes;
  Result<Scan> scan = row->reader(bytes, file.string(), quiet);
  if (!scan) return std::nullopt;
  scan->notices.clear();
  return std::move(*scan);
}

}  // namespace patchlab
