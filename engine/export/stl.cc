#include "engine/export/stl.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "engine/export/formats.h"
#include "engine/export/text.h"

namespace patchlab {
namespace {

constexpr std::size_t stl_header_size = 80;
constexpr double largest_rounding = 1e-4;  // m

void append_floats(std::string& bytes, const Vector3d& vector) {
  append_bytes(bytes, Eigen::Vector3f(vector.cast<float>()));
}

// How far single precision moves the points at most, m.
double rounding(const Triangles& mesh) {
  double largest = 0.0;
  for (const Vector3d& point : mesh.points) largest = std::max(largest, point.lpNorm<Eigen::Infinity>());
  return 0.5 * largest * std::numeric_limits<float>::epsilon();
}

}  // namespace

std::string stl_bytes(std::span<const Triangles> meshes) {
  std::string bytes = "patchlab: bounded curved patches, metre";
  bytes.resize(stl_header_size, ' ');
  std::uint32_t count = 0;
  for (const Triangles& mesh : meshes) count += static_cast<std::uint32_t>(mesh.faces.size());
  append_bytes(bytes, count);
  for (const Triangles& mesh : meshes) {
    for (const auto& [i, j, k] : mesh.faces) {
      const Vector3d &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
      append_floats(bytes, (b - a).cross(c - a).stableNormalized());
      for (const Vector3d& corner : {a, b, c}) append_floats(bytes, corner);
      append_bytes(bytes, std::uint16_t{0});
    }
  }
  return bytes;
}

Result<Exported> export_stl(const PatchSet& set, const ExportOptions& options) {
  if (const Result<std::string> frame = common_frame(set, "stl"); !frame) return frame.error();
  std::vector<Triangles> meshes;
  for (const PatchRecord& record : set.patches) {
    meshes.push_back(placed_triangles(record.patch, options));
    const double moved = rounding(meshes.back());
    if (moved <= largest_rounding) continue;
    return Error{ErrorCode::refused, "patch \"" + record.id +
                                         "\": lies so far from the origin that stl, in single precision, "
                                         "would move it by " +
                                         decimal(moved) + " m; export ply or obj. Nothing was written."};
  }
  return Exported{{{"", stl_bytes(meshes)}}, {}};
}

}  // namespace patchlab
