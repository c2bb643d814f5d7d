#include <Eigen/Geometry>
#include <algorithm>

#include "engine/export/formats.h"
#include "engine/export/world.h"
#include "engine/io/patch_json.h"

namespace patchlab {
namespace {

constexpr int field_cells = 96;  // of a height field, along each side

// The heights of a concave patch over the box around its outline. A node outside within a cell of the outline
// has its height, one farther away the lowest of all, so that the field ends at the outline, to one cell.
struct HeightField {
  Vector2d half_size;      // m
  double low, high;        // m, z in the frame of the patch
  Eigen::MatrixXf values;  // by row (y) and column (x)
};

// The place itself, or where the line from it to the centre enters the outline.
Vector2d held_within(const Boundary& bound, const Vector2d& u) {
  if (contains(bound, u)) return u;
  double inside = 0.0, outside = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (inside + outside);
    (contains(bound, middle * u) ? inside : outside) = middle;
  }
  return inside * u;
}

HeightField height_field(const Patch& patch) {
  const Boundary bound = boundary(patch);
  const Vector3d k = k3(patch);
  const Vector2d half = extent(bound), cell = 2.0 * half / field_cells;
  Eigen::MatrixXd z = Eigen::MatrixXd::Constant(field_cells + 1, field_cells + 1, NAN);
  for (int row = 0; row <= field_cells; ++row) {
    for (int column = 0; column <= field_cells; ++column) {
      const Vector2d u = Vector2d(column, row).cwiseProduct(cell) - half;
      const Vector2d held = held_within(bound, u);
      if (((u - held).cwiseAbs() - cell).maxCoeff() <= 0.0) z(row, column) = height(held, k);
    }
  }
  const double low = z.array().isNaN().select(INFINITY, z).minCoeff();
  const double high = z.array().isNaN().select(-INFINITY, z).maxCoeff();
  z = z.array().isNaN().select(low, z);
  return {half, low, high, z.cast<float>()};
}

// MuJoCo's own format: rows, columns, then the heights row by row; it scales them to [0, 1].
std::string field_bytes(const HeightField& field) {
  std::string bytes;
  append_bytes(bytes, static_cast<std::int32_t>(field.values.rows()));
  append_bytes(bytes, static_cast<std::int32_t>(field.values.cols()));
  for (const auto& row : field.values.rowwise()) {
    for (const float value : row) append_bytes(bytes, value);
  }
  return bytes;
}

struct Mjcf {
  std::string assets, geoms;
  std::vector<ExportedFile> files;
};

void add_geom(Mjcf& mjcf, const WorldPatch& patch, const std::string& shape, double z) {
  const Pose pose = world_from_patch(*patch.patch);
  const auto [qx, qy, qz, qw] = quaternion_xyzw(pose.r);
  mjcf.geoms += "    <geom name=\"" + patch.id + "\" " + shape + " pos=\"" +
                decimals(apply(pose, {0.0, 0.0, z})) + "\" quat=\"" +
                decimals(Eigen::Vector4d(qw, qx, qy, qz)) + "\"/>\n";
}

void add_field(Mjcf& mjcf, const World& world, const WorldPatch& patch) {
  const HeightField field = height_field(*patch.patch);
  const Eigen::Vector4d size(field.half_size.x(), field.half_size.y(), field.high - field.low,
                             world.thickness);
  mjcf.assets += "    <hfield name=\"" + patch.id + "\" file=\"meshes/" + patch.file + ".hfield\" size=\"" +
                 decimals(size) + "\"/>\n";
  mjcf.files.push_back({"meshes/" + patch.file + ".hfield", field_bytes(field)});
  add_geom(mjcf, patch, "type=\"hfield\" hfield=\"" + patch.id + "\"", field.low);
}

void add_mesh(Mjcf& mjcf, const World& world, const WorldPatch& patch) {
  mjcf.files.push_back(mesh_file(world, patch));
  mjcf.assets += "    <mesh name=\"" + patch.id + "\" file=\"" + mjcf.files.back().name + "\"/>\n";
  add_geom(mjcf, patch, "type=\"mesh\" mesh=\"" + patch.id + "\"", 0.0);
}

}  // namespace

Result<Exported> export_mjcf(const PatchSet& set, const ExportOptions& options) {
  const Result<World> world = world_of(set, options, "mjcf");
  if (!world) return world.error();
  Mjcf mjcf;
  for (const WorldPatch& patch : world->patches)
    patch.concave ? add_field(mjcf, *world, patch) : add_mesh(mjcf, *world, patch);
  const std::string text =
      "<mujoco model=\"patches in " + world->frame +
      "\">\n  <!-- Metre; no covariance. Concave patches and saddles are height fields, which end at the outline to one cell; the "
      "others are meshes. -->\n  <compiler angle=\"radian\"/>\n  <asset>\n" +
      mjcf.assets + "  </asset>\n  <worldbody>\n" + mjcf.geoms + "  </worldbody>\n</mujoco>\n";
  Exported out{std::move(mjcf.files), {}};
  out.files.insert(out.files.begin(), {"world.xml", text});
  return out;
}

}  // namespace patchlab
