#include "engine/io/mesh_data.h"
#include "engine/io/read_error.h"
#include "engine/io/scan_from_columns.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t off_lines_between_progress = 1 << 16;

// The lines of an OFF file that hold something, without comments.
class OffLines {
 public:
  OffLines(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

  bool next() {
    while (const auto line = lines_.next()) {
      line_ = trimmed(line->substr(0, line->find('#')));
      if (!line_.empty()) return true;
    }
    line_ = {};
    return false;
  }
  std::string_view line() const { return line_; }
  void drop_word() {
    next_word(line_);
    line_ = trimmed(line_);
  }
  std::string_view rest() const { return lines_.rest(); }
  std::size_t number() const { return lines_.number(); }
  const std::string& name() const { return name_; }
  Error wrong(const std::string& what) const { return unreadable_line(name_, lines_.number(), what); }

 private:
  LineReader lines_;
  std::string_view line_;
  const std::string& name_;
};

// What the first word says of a vertex: its own values after x y z.
struct VertexLayout {
  std::size_t least = 3, most = 3;
};

Result<VertexLayout> layout_of(std::string_view keyword, const OffLines& lines) {
  VertexLayout layout;
  if (keyword.starts_with("ST")) {
    keyword.remove_prefix(2);
    layout = {layout.least + 2, layout.most + 2};
  }
  if (keyword.starts_with("C")) {
    keyword.remove_prefix(1);
    layout = {layout.least + 3, layout.most + 4};
  }
  if (keyword.starts_with("N")) {
    keyword.remove_prefix(1);
    layout = {layout.least + 3, layout.most + 3};
  }
  if (keyword == "OFF") return layout;
  return lines.wrong("an OFF file of another dimension than three is not read; save it as OFF.");
}

struct Counts {
  std::uint64_t vertices = 0, faces = 0;
};

Result<Counts> counts_of(OffLines& lines) {
  if (lines.line().empty() && !lines.next())
    return lines.wrong("the counts of vertices and faces are missing.");
  std::string_view rest = lines.line();
  const auto vertices = parse_number<std::uint64_t>(next_word(rest));
  const auto faces = parse_number<std::uint64_t>(next_word(rest));
  if (!vertices || !faces || *vertices == 0)
    return lines.wrong(shown(lines.line()) + " is no count of vertices (one at least) and faces.");
  constexpr std::uint64_t bytes_a_vertex = 6, bytes_a_face = 2;  // a digit and what separates it
  const std::uint64_t left = lines.rest().size() + 1;
  if (*vertices > left / bytes_a_vertex || *faces > left / bytes_a_face) {
    return lines.wrong(std::to_string(*vertices) + " vertices and " + std::to_string(*faces) +
                       " faces do not fit in the " + std::to_string(left - 1) +
                       " bytes that follow; the file is cut off or its counts are wrong.");
  }
  return Counts{*vertices, *faces};
}

Result<Eigen::Vector3d> vertex_of(const OffLines& lines, const VertexLayout& layout) {
  std::string_view rest = lines.line();
  Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
  std::size_t values = 0;
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++values) {
    const auto number = parse_number<double>(word);
    if (!number) return lines.wrong(shown(word) + " in a vertex is not a number.");
    if (values < 3) vertex(static_cast<Eigen::Index>(values)) = *number;
  }
  if (values >= layout.least && values <= layout.most) return vertex;
  return lines.wrong("a vertex has " + std::to_string(values) + " values, not " +
                     std::to_string(layout.least) + ".");
}

Result<std::vector<std::int64_t>> corners_of(const OffLines& lines) {
  std::string_view rest = lines.line();
  const std::string_view size_word = next_word(rest);
  const auto size = parse_number<std::int64_t>(size_word);
  if (!size) return lines.wrong(shown(size_word) + " is no number of corners of a face.");
  std::vector<std::int64_t> corners;
  for (std::int64_t i = 0; i < *size; ++i) {
    const std::string_view word = next_word(rest);
    if (word.empty()) return std::vector<std::int64_t>{};  // a face that is cut short is a bad one
    corners.push_back(parse_number<std::int64_t>(word).value_or(-1));
  }
  return corners;
}

Result<void> fill(OffLines& lines, const Counts& counts, const VertexLayout& layout, MeshData& mesh,
                  const ReadOptions& options) {
  const auto all = static_cast<double>(counts.vertices + counts.faces);
  for (std::uint64_t i = 0; i < counts.vertices + counts.faces; ++i) {
    if (!lines.next()) {
      return unreadable(lines.name(), "it ends before its last " +
                                          std::string(i < counts.vertices ? "vertex" : "face") +
                                          "; the file is cut off or its counts are wrong.");
    }
    if (i < counts.vertices) {
      const Result<Eigen::Vector3d> vertex = vertex_of(lines, layout);
      if (!vertex) return vertex.error();
      mesh.vertices.push_back(*vertex);
    } else {
      const Result<std::vector<std::int64_t>> corners = corners_of(lines);
      if (!corners) return corners.error();
      add_face(mesh, *corners, mesh.vertices.size());
    }
    if (i % off_lines_between_progress == off_lines_between_progress - 1 &&
        !keep_going(options.progress, static_cast<double>(i) / all))
      return Error{ErrorCode::cancelled, lines.name() + ": reading was cancelled."};
  }
  return {};
}

}  // namespace

Result<MeshData> parse_off(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  MeshData mesh;
  mesh.format = "off";
  mesh.encoding = "ascii";
  OffLines lines(bytes, name);
  if (!lines.next()) return unreadable(name, "is empty.");
  std::string_view first = lines.line();
  const Result<VertexLayout> layout = layout_of(next_word(first), lines);
  if (!layout) return layout.error();
  lines.drop_word();
  if (lines.line() == "BINARY") return lines.wrong("a binary OFF file is not read; save it as text.");
  const Result<Counts> counts = counts_of(lines);
  if (!counts) return counts.error();
  if (const auto fits = check_memory(name, counts->vertices, 0, options); !fits) return fits.error();
  mesh.vertices.reserve(counts->vertices);
  if (const auto filled = fill(lines, *counts, *layout, mesh, options); !filled) return filled.error();
  if (layout->most > 3)
    mesh.notices.emplace_back("Colours, normals and texture coordinates of the vertices were left out.");
  if (lines.next()) mesh.notices.emplace_back("Lines after the last face were left out.");
  return mesh;
}

}  // namespace patchlab
