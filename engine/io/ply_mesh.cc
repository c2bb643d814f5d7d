#include "engine/io/mesh_data.h"
#include "engine/io/ply_elements.h"
#include "engine/io/read_error.h"

namespace patchlab {
namespace {

Result<void> take_vertices(const PlyElementData& data, std::uint64_t count, const std::string& name,
                           MeshData& mesh) {
  const auto xyz = find_columns<3>(data.columns, {"x", "y", "z"});
  if (!is_complete(xyz)) return unreadable(name, "its vertices lack x, y or z.");
  mesh.vertices.resize(count);
  for (std::size_t axis = 0; axis < 3; ++axis)
    gather(*xyz[axis], count, 0, mesh.vertices[0].data() + axis, 3);
  return {};
}

}  // namespace

Result<MeshData> parse_ply(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const Result<PlyHeader> header = parse_ply_header(bytes, name);
  if (!header) return header.error();
  const auto vertex = std::ranges::find(header->elements, "vertex", &PlyElement::name);
  if (vertex == header->elements.end() || vertex->count == 0)
    return unreadable(name, "the PLY file holds no vertices.");
  MeshData mesh;
  mesh.format = "ply";
  mesh.encoding = header->encoding;
  PlyFaces faces;
  PlyCursor cursor(bytes, *header, name);
  for (const PlyElement& element : header->elements) {
    PlyFaces* const kept = element.name == "face" ? &faces : nullptr;
    const Result<PlyElementData> data = read_ply_element(cursor, element, vertex->count, options, kept);
    if (!data) return data.error();
    if (&element != &*vertex) continue;
    if (const auto taken = take_vertices(*data, vertex->count, name, mesh); !taken) return taken.error();
  }
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    add_face(mesh, std::span(faces.corners).subspan(begin, end - begin), mesh.vertices.size());
    begin = end;
  }
  return mesh;
}

}  // namespace patchlab
