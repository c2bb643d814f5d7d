#include "engine/io/scene_mesh.h"

#include "engine/base/file.h"
#include "engine/io/mesh_data.h"
#include "engine/io/patch_json.h"

namespace patchlab {
namespace {

LengthUnit unit_of(const JsonPlace& object) {
  const auto place = object.find("unit");
  if (!place) return LengthUnit::m;
  const auto unit = length_unit_from_name(place->text());
  if (!unit) place->fail("is none of the units m, mm, cm and in");
  return unit.value_or(LengthUnit::m);
}

Result<MeshData> read_mesh_file(const std::filesystem::path& file) {
  const Result<Bytes> bytes = read_file(file);
  if (!bytes) return bytes.error();
  return parse_mesh(as_text(*bytes), file.string(), {});
}

}  // namespace

std::shared_ptr<const RayMesh> mesh_from_json(const JsonPlace& object, const std::filesystem::path& folder) {
  const JsonPlace file = object["mesh"];
  const double unit = metres(unit_of(object));
  Viewpoint world_from_mesh;
  if (const auto pose = object.find("pose")) world_from_mesh = viewpoint_from_json(*pose);
  if (!object.ok()) return nullptr;
  if (file.text().empty()) file.fail("is empty");
  if (!object.ok()) return nullptr;
  Result<MeshData> mesh = read_mesh_file(folder / file.text());
  if (!mesh) {
    file.fail("cannot be used: " + mesh.error().message);
    return nullptr;
  }
  const Eigen::Matrix3d R_world_mesh = rotation(world_from_mesh);
  for (Eigen::Vector3d& vertex : mesh->vertices)
    vertex = R_world_mesh * (unit * vertex) + world_from_mesh.position;
  return std::make_shared<const RayMesh>(std::move(mesh->vertices), std::move(mesh->triangles));
}

}  // namespace patchlab
