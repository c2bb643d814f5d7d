#include "engine/scan/scan.h"

#include <Eigen/Geometry>
#include <limits>

namespace patchlab {

Eigen::Matrix3d rotation(const Viewpoint& viewpoint) {
  const auto& [x, y, z, w] = viewpoint.quaternion_xyzw;
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

std::optional<Bounds> bounds(const Scan& scan) {
  if (scan.finite_count == 0) return std::nullopt;
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = -low;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    low = low.min(scan.positions[i].array());
    high = high.max(scan.positions[i].array());
  }
  return Bounds{scan.origin + low.matrix().cast<double>(), scan.origin + high.matrix().cast<double>()};
}

}  // namespace patchlab
