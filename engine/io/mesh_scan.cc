#include "engine/io/mesh_data.h"
#include "engine/io/read_error.h"
#include "engine/io/scan_from_columns.h"

namespace patchlab {
namespace {

using Parse = Result<MeshData> (*)(std::string_view bytes, const std::string& name,
                                   const ReadOptions& options);

std::string faces_notice(const MeshData& mesh) {
  const std::string damaged =
      mesh.bad_faces == 0 ? "" : ", " + std::to_string(mesh.bad_faces) + " of them damaged,";
  return "The vertices of the mesh are read as points; its " + std::to_string(mesh.faces) + " faces" +
         damaged + " were left out.";
}

// The vertices as the points of a scan.
template <Parse parse>
Result<Scan> read_mesh_as(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  Result<MeshData> mesh = parse(bytes, name, options);
  if (!mesh) return mesh.error();
  const std::size_t points = mesh->vertices.size();
  if (const auto fits = check_memory(name, points, 0, options); !fits) return fits.error();
  Scan scan;
  scan.file = name;
  scan.format = mesh->format;
  scan.encoding = mesh->encoding;
  scan.width = static_cast<std::uint32_t>(points);
  scan.notices = std::move(mesh->notices);
  if (mesh->faces > 0) scan.notices.push_back(faces_notice(*mesh));
  scan.notices.push_back(std::string("A mesh states no viewpoint").append(at_the_origin));
  const bool is_float = mesh->format == "stl";
  std::vector<Column> columns;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string axis_name(1, static_cast<char>('x' + axis));
    scan.fields.push_back({axis_name, is_float ? "float32" : "float64", 1});
    columns.push_back({axis_name, Scalar::float64, 1,
                       reinterpret_cast<const char*>(mesh->vertices[0].data() + axis),
                       sizeof(Eigen::Vector3d)});
  }
  const OriginRule rule = is_float ? OriginRule::where_large : OriginRule::always;
  if (const auto filled = fill_scan(scan, columns, points, rule, options); !filled) return filled.error();
  return scan;
}

}  // namespace

Result<Scan> read_obj(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return read_mesh_as<parse_obj>(bytes, name, options);
}
Result<Scan> read_off(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return read_mesh_as<parse_off>(bytes, name, options);
}
Result<Scan> read_stl(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return read_mesh_as<parse_stl>(bytes, name, options);
}

}  // namespace patchlab
