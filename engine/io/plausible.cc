#include "engine/io/plausible.h"

#include <algorithm>
#include <cmath>

namespace patchlab {
namespace {

constexpr double huge = 1e7;    // m: no map projection reaches it
constexpr double tiny = 1e-30;  // m: only damage is smaller, but for zero

bool strange(double value) {
  const double size = std::abs(value);
  return size > huge || (size < tiny && size > 0.0);
}

// Share of the points with finite coordinates that have a strange one.
double strange_share(const std::vector<Eigen::Vector3d>& points) {
  std::size_t finite = 0, bad = 0;
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite()) continue;
    ++finite;
    if (strange(point.x()) || strange(point.y()) || strange(point.z())) ++bad;
  }
  return finite == 0 ? 0.0 : static_cast<double>(bad) / static_cast<double>(finite);
}

bool makes_sense(const std::array<Column, 3>& xyz, std::size_t points) {
  std::vector<Eigen::Vector3d> read(points);
  for (std::size_t axis = 0; axis < 3; ++axis) gather(xyz[axis], points, 0, read[0].data() + axis, 3);
  const auto finite =
      std::ranges::count_if(read, [](const Eigen::Vector3d& point) { return point.allFinite(); });
  return 2 * static_cast<std::size_t>(finite) > points && strange_share(read) < 0.1;
}

Scalar other_kind(Scalar type) {
  switch (type) {
    case Scalar::int32:
    case Scalar::uint32:
      return Scalar::float32;
    case Scalar::int64:
    case Scalar::uint64:
      return Scalar::float64;
    case Scalar::float32:
      return Scalar::int32;
    case Scalar::float64:
      return Scalar::int64;
    default:
      return type;
  }
}

}  // namespace

Plausibility judge_coordinates(const std::array<Column, 3>& xyz, const std::vector<Eigen::Vector3d>& points) {
  if (strange_share(points) <= 0.5) return Plausibility::plausible;
  std::array<Column, 3> swapped = xyz, retyped = xyz;
  for (Column& column : swapped) column.swapped = !column.swapped;
  for (Column& column : retyped) column.type = other_kind(column.type);
  if (makes_sense(swapped, points.size())) return Plausibility::other_order;
  if (makes_sense(retyped, points.size())) return Plausibility::other_type;
  return Plausibility::doubtful;
}

}  // namespace patchlab
