#include "engine/map/overlap.h"

#include <algorithm>

namespace patchlab {
namespace {

constexpr int grid = 9;
constexpr double least_cosine = 0.5;  // of the normals of one surface

struct Covered {
  double share = 0.0;
  Vector3d points = Vector3d::Zero(), normals = Vector3d::Zero();  // sums
  int count = 0;
};

// What of a's points the grown bounds of b cover.
Covered covered(const SampledPatch& a, const Patch& b, double margin) {
  const Boundary bound = grown(boundary(b), margin);
  const Pose pose = world_from_patch(b);
  const Matrix3d R = axes(b);
  const Vector3d kappa = k3(b);
  Covered out;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Vector3d q_b = R.transpose() * (a.points[i] - pose.t);
    if (!contains(bound, q_b.head<2>())) continue;
    const Vector3d normal_b = R * outward_normal(surface_point(q_b.head<2>(), kappa), kappa);
    if (normal_b.dot(a.normals[i]) < least_cosine) continue;
    out.points += a.points[i];
    out.normals += a.normals[i] + normal_b;
    ++out.count;
  }
  out.share = static_cast<double>(out.count) / static_cast<double>(a.points.size());
  return out;
}

}  // namespace

Boundary grown(const Boundary& boundary, double margin) {
  Boundary out = boundary;
  const Eigen::Index lengths = out.type == BoundaryType::convex_quad ? 4 : out.d.size();
  out.d.head(lengths).array() += margin;
  return out;
}

SampledPatch sampled(const Patch& patch) {
  SampledPatch out{patch, {}, {}, Vector3d::Zero(), 0.0};
  const Boundary bound = boundary(patch);
  const Vector2d box = extent(bound);
  const Pose pose = world_from_patch(patch);
  const Matrix3d R = axes(patch);
  const Vector3d kappa = k3(patch);
  for (int i = 0; i < grid * grid; ++i) {
    const Vector2d at((2.0 * (i % grid) + 1.0) / grid - 1.0, (2.0 * (i / grid) + 1.0) / grid - 1.0);
    const Vector2d u = box.cwiseProduct(at);
    if (!contains(bound, u)) continue;
    const Vector3d q = surface_point(u, kappa);
    out.points.push_back(R * q + pose.t);
    out.normals.push_back(R * outward_normal(q, kappa));
    out.middle += out.points.back();
  }
  if (out.points.empty()) {  // a sliver between the points of the grid
    out.points = {pose.t};
    out.normals = {R.col(2)};
    out.middle = pose.t;
  }
  out.middle /= static_cast<double>(out.points.size());
  for (const Vector3d& q : out.points) out.radius = std::max(out.radius, (q - out.middle).norm());
  return out;
}

SampledPatch turned_over(const SampledPatch& patch) {
  SampledPatch out = patch;
  out.patch = flip_normal(patch.patch);
  for (Vector3d& normal : out.normals) normal = -normal;
  return out;
}

Overlap overlap(const SampledPatch& a, const SampledPatch& b, double margin) {
  Overlap out;
  const double reach = 1.3 * (a.radius + b.radius) + 2.0 * margin;  // the outline lies beyond the points
  if ((a.middle - b.middle).norm() > reach) return out;
  const Covered of_a = covered(a, b.patch, margin), of_b = covered(b, a.patch, margin);
  if (of_a.count + of_b.count == 0) return out;
  out.share = std::max(of_a.share, of_b.share);
  const double area_a = area(boundary(a.patch)), area_b = area(boundary(b.patch));
  const double shared = 0.5 * (of_a.share * area_a + of_b.share * area_b);
  out.jaccard = shared / (area_a + area_b - shared);
  out.point = (of_a.points + of_b.points) / (of_a.count + of_b.count);
  out.normal = (of_a.normals + of_b.normals).normalized();
  return out;
}

}  // namespace patchlab
