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

bool is_floating(Scalar type) { return type == Scalar::float32 || type == Scalar::float64; }

// Integers of the size of a floating point number, and the other way round.
Scalar other_kind(Scalar type) {
  if (is_floating(type)) return type == Scalar::float32 ? Scalar::int32 : Scalar::int64;
  return size_of(type) == 4 ? Scalar::float32 : size_of(type) == 8 ? Scalar::float64 : type;
}

}  // namespace

Plausibility judge_coordinates(const std::array<Column, 3>& xyz, const std::vector<Eigen::Vector3d>& points) {
  if (strange_share(points) <= 0.5) return Plausibility::plausible;
  std::array<Column, 3> swapped = xyz, retyped = xyz;
  for (Column& column : swapped) column.swapped = !column.swapped;
  for (Column& column : retyped) column.type = other_kind(column.type);
  // Reversed floating point numbers look like small integers, so either may seem to explain the other.
  const bool order = makes_sense(swapped, points.size()), type = makes_sense(retyped, points.size());
  if (order && (is_floating(xyz[0].type) || !type)) return Plausibility::other_order;
  if (type) return Plausibility::other_type;
  return Plausibility::doubtful;
}

}  // namespace patchlab
