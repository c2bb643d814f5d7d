#include <algorithm>
#include <span>

#include "engine/io/mesh_data.h"
#include "engine/io/read_error.h"
#include "engine/io/scan_from_columns.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t obj_lines_between_progress = 1 << 16;
constexpr std::string_view without_points[] = {
    "vt",     "vn",     "vp",     "p",          "l",         "o",    "g",    "s",     "mg",       "mtllib",
    "usemtl", "usemap", "maplib", "cstype",     "deg",       "bmat", "step", "curv",  "curv2",    "surf",
    "parm",   "trim",   "hole",   "scrv",       "sp",        "end",  "con",  "bevel", "c_interp", "d_interp",
    "lod",    "ctech",  "stech",  "shadow_obj", "trace_obj", "call", "csh"};

// A face waits for all vertices: some writers put faces first, and negative indices count from the vertices
// that are there when the face is read.
struct Faces {
  std::vector<std::int64_t> corners;  // of all faces, one after another, counted from 0; -1: no index
  std::vector<std::size_t> ends;      // of each face in `corners`
};

Error wrong(const std::string& name, std::size_t line, const std::string& what) {
  return unreadable_line(name, line, what);
}

Result<void> add_vertex(std::string_view rest, std::size_t line, const std::string& name, MeshData& mesh) {
  Eigen::Vector3d vertex;
  std::size_t values = 0;
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++values) {
    const auto number = parse_number<double>(word);
    if (!number) return wrong(name, line, shown(word) + " in a vertex is not a number.");
    if (values < 3) vertex(static_cast<Eigen::Index>(values)) = *number;
  }
  // x y z, and then a weight, or a colour, or both
  if (values < 3 || values > 7 || values == 5)
    return wrong(name, line, "a vertex has " + std::to_string(values) + " values, not x y z.");
  mesh.vertices.push_back(vertex);
  return {};
}

std::int64_t corner(std::string_view word, std::size_t vertices) {
  const auto index = parse_number<std::int64_t>(word.substr(0, word.find('/')));
  if (!index || *index == 0) return -1;
  return *index > 0 ? *index - 1 : std::max<std::int64_t>(static_cast<std::int64_t>(vertices) + *index, -1);
}

void add_face_line(std::string_view rest, std::size_t vertices, Faces& faces) {
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
    faces.corners.push_back(corner(word, vertices));
  }
  faces.ends.push_back(faces.corners.size());
}

// A line may go on in the next one after a backslash.
std::string_view whole_line(LineReader& lines, std::string_view line, std::string& joined) {
  if (!line.ends_with('\\')) return line;
  joined.clear();
  while (line.ends_with('\\')) {
    joined.append(line.substr(0, line.size() - 1)).push_back(' ');
    line = lines.next().value_or(std::string_view{});
  }
  joined.append(line);
  return joined;
}

Result<void> add_line(std::string_view rest, std::size_t number, const std::string& name, MeshData& mesh,
                      Faces& faces) {
  const std::string_view entry = next_word(rest);
  if (entry.empty() || entry.front() == '#') return {};
  if (entry == "v" || entry == "f") rest = rest.substr(0, rest.find('#'));  // a comment may follow
  if (entry == "v") return add_vertex(rest, number, name, mesh);
  if (entry == "f") {
    add_face_line(rest, mesh.vertices.size(), faces);
    return {};
  }
  if (std::ranges::find(without_points, entry) != std::end(without_points)) return {};
  return wrong(name, number, shown(entry) + " is no entry of an OBJ file.");
}

}  // namespace

Result<MeshData> parse_obj(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  MeshData mesh;
  mesh.format = "obj";
  mesh.encoding = "ascii";
  Faces faces;
  LineReader lines(bytes);
  std::string joined;
  const auto all = static_cast<double>(bytes.size() + 1);
  while (const auto line = lines.next()) {
    const auto added = add_line(whole_line(lines, *line, joined), lines.number(), name, mesh, faces);
    if (!added) return added.error();
    if (lines.number() % obj_lines_between_progress != 0) continue;
    if (!keep_going(options.progress, 1.0 - static_cast<double>(lines.rest().size()) / all))
      return Error{ErrorCode::cancelled, name + ": reading was cancelled."};
    if (const auto fits = check_memory(name, mesh.vertices.size(), 0, options); !fits) return fits.error();
  }
  if (mesh.vertices.empty()) return unreadable(name, "holds no vertices.");
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    add_face(mesh, std::span(faces.corners).subspan(begin, end - begin), mesh.vertices.size());
    begin = end;
  }
  return mesh;
}

}  // namespace patchlab
