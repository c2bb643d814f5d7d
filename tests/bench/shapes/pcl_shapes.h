// The same shapes by PCL.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace patchlab::bench {

enum class Shape { plane, sphere, cylinder };

// PCL's own copy of some points with their normals, which it takes for cylinders only.
class PclPoints {
 public:
  PclPoints(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& normals);
  ~PclPoints();
  PclPoints(PclPoints&&) noexcept;

  // RANSAC, then the best of its inliers by optimizeModelCoefficients, no covariance. The radius, 0 of a
  // plane.
  double fit(Shape shape) const;

 private:
  struct Clouds;
  std::unique_ptr<Clouds> clouds_;
};

}  // namespace patchlab::bench
