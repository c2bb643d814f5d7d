#include "engine/export/foothold.h"

#include <algorithm>

#include "engine/patch/marginals.h"

namespace patchlab {
namespace {

constexpr int outline_points = 128;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// What lies left of the line from `a` to `b` and `inset` away from it.
std::vector<Vector2d> clipped(const std::vector<Vector2d>& polygon, const Vector2d& a, const Vector2d& b,
                              double inset) {
  const Vector2d along = (b - a).normalized();
  const auto left = [&](const Vector2d& p) { return cross(along, p - a) - inset; };
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = left(p), at_q = left(q);
    if (at_p >= 0.0) out.push_back(p);
    if (at_p * at_q < 0.0) out.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return out;
}

// Without corners that coincide.
std::vector<Vector2d> tidy(const std::vector<Vector2d>& polygon, double tolerance) {
  std::vector<Vector2d> out;
  for (const Vector2d& corner : polygon) {
    if (out.empty() || (corner - out.back()).norm() > tolerance) out.push_back(corner);
  }
  while (out.size() > 1 && (out.front() - out.back()).norm() <= tolerance) out.pop_back();
  return out;
}

}  // namespace

double polygon_area(const std::vector<Vector2d>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

std::vector<Vector2d> inner_polygon(const Patch& patch, double inset_sigmas, double foot_radius) {
  const std::vector<Vector2d> edge = outline(boundary(patch), outline_points);
  std::vector<double> inset(edge.size(), foot_radius);
  if (patch.covariance_local) {
    const std::vector<BandPoint> band = outline_band(patch, outline_points);  // the same points
    for (std::size_t i = 0; i < edge.size(); ++i) inset[i] += inset_sigmas * band[i].sigma;
  }
  const Vector2d far = 2.0 * extent(boundary(patch));
  std::vector<Vector2d> polygon = {far, {-far.x(), far.y()}, -far, {far.x(), -far.y()}};
  const double tolerance = 1e-9 * far.norm();
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const std::size_t j = (i + 1) % edge.size();
    if ((edge[j] - edge[i]).norm() > tolerance)
      polygon = clipped(polygon, edge[i], edge[j], std::max(inset[i], inset[j]));
  }
  polygon = tidy(polygon, tolerance);
  return polygon.size() < 3 ? std::vector<Vector2d>() : polygon;
}

Vector2d height_range(const Patch& patch, const std::vector<Vector2d>& polygon) {
  constexpr int steps = 16;
  const Vector3d k = k3(patch);
  Vector2d range = Vector2d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    for (int step = 0; step < steps; ++step) {
      const double z = height(from + (to - from) * step / steps, k);
      range = {std::min(range[0], z), std::max(range[1], z)};
    }
  }
  return range;
}

}  // namespace patchlab
