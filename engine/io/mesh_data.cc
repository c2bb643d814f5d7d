#include "engine/io/mesh_data.h"

#include <algorithm>

#include "engine/io/read_error.h"
#include "engine/io/recognise.h"

namespace patchlab {
namespace {

using ParseMesh = Result<MeshData> (*)(std::string_view bytes, const std::string& name,
                                       const ReadOptions& options);

struct MeshFormat {
  ScanReader reader;
  ParseMesh parse;
};
constexpr MeshFormat mesh_formats[] = {
    {read_obj, parse_obj}, {read_off, parse_off}, {read_stl, parse_stl}, {read_ply, parse_ply}};

}  // namespace

void add_face(MeshData& mesh, std::span<const std::int64_t> corners, std::size_t vertices) {
  const auto there = [&](std::int64_t index) {
    return index >= 0 && index < static_cast<std::int64_t>(vertices);
  };
  ++mesh.faces;
  if (corners.size() < 3 || !std::ranges::all_of(corners, there)) {
    ++mesh.bad_faces;
    return;
  }
  const auto id = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
  for (std::size_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({id(0), id(i - 1), id(i)});
}

Result<MeshData> parse_mesh(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const auto* const format = std::ranges::find(mesh_formats, scan_reader(bytes, name), &MeshFormat::reader);
  if (format == std::end(mesh_formats)) return unreadable(name, "is no mesh: no OBJ, OFF, STL or PLY file.");
  Result<MeshData> mesh = format->parse(bytes, name, options);
  if (mesh && mesh->triangles.empty()) return unreadable(name, "holds no face, so it is no mesh.");
  return mesh;
}

}  // namespace patchlab
