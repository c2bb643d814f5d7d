#include <cmath>

#include "engine/export/formats.h"
#include "engine/export/world.h"

namespace patchlab {
namespace {

// R = Rz(yaw) Ry(pitch) Rx(roll), as URDF has it.
Vector3d roll_pitch_yaw(const Matrix3d& R) {
  const double yaw = std::atan2(R(1, 0), R(0, 0)), c = std::cos(yaw), s = std::sin(yaw);
  return {std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)),
          std::atan2(-R(2, 0), c * R(0, 0) + s * R(1, 0)), yaw};
}

std::string link(const World& world, const WorldPatch& patch) {
  const std::string concave = patch.concave ? " concave=\"yes\"" : "";
  const std::string mesh = "<geometry><mesh filename=\"meshes/" + patch.file + ".stl\"/></geometry>";
  return "  <link name=\"" + patch.id + "\"" + concave + ">\n    <visual>" + mesh +
         "</visual>\n    <collision" + concave + ">" + mesh + "</collision>\n  </link>\n  <joint name=\"" +
         world.frame + " to " + patch.id + "\" type=\"fixed\">\n    <parent link=\"" + world.frame +
         "\"/>\n    <child link=\"" + patch.id + "\"/>\n    <origin xyz=\"" + decimals(centre(*patch.patch)) +
         "\" rpy=\"" + decimals(roll_pitch_yaw(axes(*patch.patch))) + "\"/>\n  </joint>\n";
}

}  // namespace

Result<Exported> export_urdf(const PatchSet& set, const ExportOptions& options) {
  const Result<World> world = world_of(set, options, "urdf");
  if (!world) return world.error();
  Exported out;
  std::string text =
      "<?xml version=\"1.0\"?>\n<robot name=\"patches\">\n  <!-- Metre, radian; no covariance. -->\n  <link name=\"" +
      world->frame + "\"/>\n";
  for (const WorldPatch& patch : world->patches) {
    if (patch.id == world->frame) {
      return Error{ErrorCode::refused,
                   "patch \"" + patch.id +
                       "\": has the name of the frame it stands in, and a URDF needs two; "
                       "rename it. Nothing was written."};
    }
    text += link(*world, patch);
    out.files.push_back(mesh_file(*world, patch));
  }
  out.files.insert(out.files.begin(), {"world.urdf", text + "</robot>\n"});
  return out;
}

}  // namespace patchlab
