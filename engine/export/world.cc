#include "engine/export/world.h"

#include <algorithm>

#include "engine/export/stl.h"
#include "engine/export/triangles.h"

namespace patchlab {
namespace {

constexpr double noticeable_rise = 1e-5;  // m

bool rises(const Patch& patch) {
  const Vector3d k = k3(patch);
  return std::ranges::any_of(outline(boundary(patch), 64),
                             [&](const Vector2d& u) { return height(u, k.cwiseMax(0.0)) > noticeable_rise; });
}

}  // namespace

Result<World> world_of(const PatchSet& set, const ExportOptions& options, std::string_view format) {
  const Result<std::string> frame = common_frame(set, format);
  if (!frame) return frame.error();
  World world{frame->empty() ? "world" : xml(*frame), options.thickness.value_or(default_thickness), {}};
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const PatchRecord& record = set.patches[i];
    world.patches.push_back({&record.patch, xml(record.id), plain_name(record.id, i), rises(record.patch)});
  }
  return world;
}

ExportedFile mesh_file(const World& world, const WorldPatch& patch) {
  const Triangles solid = thick_solid(*patch.patch, world.thickness);
  return {"meshes/" + patch.file + ".stl", stl_bytes({&solid, 1})};
}

}  // namespace patchlab
