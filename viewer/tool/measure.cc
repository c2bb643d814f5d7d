#include "viewer/tool/measure.h"

#include <cmath>

namespace patchlab::viewer {

MeasuredDistance distance(const MeasuredPoint& one, const MeasuredPoint& other) {
  const Eigen::Vector3d between = other.position - one.position;
  const double metres = between.norm();
  const Eigen::Matrix3d cov = one.cov + other.cov;
  if (metres == 0.0) return {0.0, std::sqrt(cov.trace() / 3.0)};
  const Eigen::Vector3d along = between / metres;  // d distance / d other
  return {metres, std::sqrt(along.dot(cov * along))};
}

}  // namespace patchlab::viewer
