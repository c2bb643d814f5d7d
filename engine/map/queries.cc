#include "engine/map/queries.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/map/common_form.h"

namespace patchlab {
namespace {

Matrix3d cov_of_centre(const Patch& patch) {
  const Matrix3d R = axes(patch);
  return R * cov_local_or_zero(patch).bottomRightCorner<3, 3>() * R.transpose();
}

// Of the normal in the world: d n = R (w_y, -w_x, 0).
Matrix3d cov_of_normal(const Patch& patch) {
  const int at = patch.type->rotation_at();
  Eigen::Matrix<double, 3, 2> J;
  J << -axes(patch).col(1), axes(patch).col(0);
  return J * cov_local_or_zero(patch).block<2, 2>(at, at) * J.transpose();
}

double root(double variance) { return std::sqrt(std::max(0.0, variance)); }

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// Of the angle between n and a direction, where `cov` is that of their difference.
double angle_sigma(const Vector3d& n, const Vector3d& direction, const Matrix3d& cov) {
  const Vector3d across = direction - n * n.dot(direction);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(cov, Eigen::EigenvaluesOnly);
  const double worst = root(solver.eigenvalues()[2]);
  if (across.norm() <= worst) return worst;
  const Vector3d away = -across.normalized();
  return root(away.dot(cov * away));
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// One point of the foot against the ground: clearance, and its derivatives by both local charts.
struct Clearance {
  double value;
  PatchVector J_foot, J_ground;
  bool held;  // within the ground's bounds
};

Clearance clearance(const Patch& foot, const Patch& ground, const Vector2d& u) {
  const Vector3d k_foot = k3(foot), k_ground = k3(ground), q_foot = surface_point(u, k_foot);
  const Vector3d q_ground = apply_inverse(world_from_patch(ground), apply(world_from_patch(foot), q_foot));
  const FootPoint nearest = foot_point(q_ground, Matrix3d::Identity(), k_ground);
  const Vector3d& x = nearest.x;
  const Vector3d n = outward_normal(x, k_ground), m = axes(foot).transpose() * (axes(ground) * n);
  const double g = gradient(x, k_ground).norm();
  const PatchTypeRow &of_foot = *foot.type, &of_ground = *ground.type;
  Clearance out{-nearest.distance, PatchVector::Zero(of_foot.size()), PatchVector::Zero(of_ground.size()),
                false};
  out.J_foot.segment(of_foot.curvature_at(), of_foot.curvature_size) =
      m.z() * (J_height_k3(u, k_foot) * of_foot.B).transpose();
  out.J_foot.segment(of_foot.rotation_at(), of_foot.rotation_size) =
      q_foot.cross(m).head(of_foot.rotation_size);
  out.J_foot.tail<3>() = m;
  out.J_ground.segment(of_ground.curvature_at(), of_ground.curvature_size) =
      -(x.cwiseProduct(x).transpose() * of_ground.B).transpose() / g;
  out.J_ground.segment(of_ground.rotation_at(), of_ground.rotation_size) =
      -x.cross(n).head(of_ground.rotation_size);
  out.J_ground.tail<3>() = -n;
  out.held = contains(boundary(ground), x.head<2>()) && on_modelled_sheet(x, k_ground);
  return out;
}

// The outline and rings within it.
std::vector<Vector2d> spread(const Boundary& boundary) {
  std::vector<Vector2d> out = {Vector2d::Zero()};
  for (const Vector2d& u : outline(boundary, 32)) {
    for (const double s : {0.25, 0.5, 0.75, 1.0}) out.push_back(s * u);
  }
  return out;
}

}  // namespace

Estimate centre_distance(const Patch& a, const Patch& b) {
  const Vector3d apart = centre(b) - centre(a);
  const Matrix3d cov = cov_of_centre(a) + cov_of_centre(b);
  const double distance = apart.norm();
  if (distance == 0.0) return {0.0, root(Eigen::SelfAdjointEigenSolver<Matrix3d>(cov).eigenvalues()[2])};
  return {distance, root(apart.dot(cov * apart)) / distance};
}

Estimate normal_angle(const Patch& a, const Patch& b) {
  const Vector3d n_a = axes(a).col(2), n_b = axes(b).col(2);
  // About the axis n_a x n_b both normals turn in one plane, each across itself.
  const Vector3d axis = n_a.cross(n_b);
  const Matrix3d cov_a = cov_of_normal(a), cov_b = cov_of_normal(b);
  const double worst = root(Eigen::SelfAdjointEigenSolver<Matrix3d>(cov_a + cov_b).eigenvalues()[2]);
  const double angle = angle_between(n_a, n_b);
  if (axis.norm() <= worst) return {angle, worst};
  const Vector3d unit = axis.normalized(), along_a = unit.cross(n_a), along_b = unit.cross(n_b);
  return {angle, root(along_a.dot(cov_a * along_a) + along_b.dot(cov_b * along_b))};
}

Estimate tilt(const Patch& patch, const Vector3d& up) {
  const Vector3d n = axes(patch).col(2);
  return {angle_between(n, up), angle_sigma(n, up.normalized(), cov_of_normal(patch))};
}

double tilt_exceeds(const Patch& patch, const Vector3d& up, double limit) {
  const Vector3d up_patch = axes(patch).transpose() * up.normalized();
  const double mean = std::atan2(up_patch.head<2>().norm(), up_patch.z());
  const Vector2d away =
      up_patch.head<2>().norm() > 0.0 ? Vector2d(-up_patch.head<2>().normalized()) : Vector2d(1.0, 0.0);
  Matrix2d J;  // (along the tilt, across it) by (w_x, w_y); d n = (w_y, -w_x)
  J << -away.y(), away.x(), -away.x(), -away.y();
  const int at = patch.type->rotation_at();
  const Matrix2d cov = J * cov_local_or_zero(patch).block<2, 2>(at, at) * J.transpose();
  const double sigma_b = std::max(root(cov(1, 1)), 1e-15), slope = cov(0, 1) / (sigma_b * sigma_b);
  const double sigma_a = std::max(root(cov(0, 0) - slope * cov(0, 1)), 1e-15);
  // cos(angle) = cos(mean + a) cos(b): inside while |mean + a| < arccos(cos(limit) / cos(b)).
  constexpr int steps = 400;
  constexpr double reach = 8.0;
  double inside = 0.0, total = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double z = reach * ((2.0 * i + 1.0) / steps - 1.0), weight = std::exp(-0.5 * z * z),
                 b = z * sigma_b;
    total += weight;
    const double ratio = std::cos(limit) / std::cos(b);
    if (!(ratio < 1.0)) continue;
    const double edge = std::acos(std::max(-1.0, ratio)), middle = mean + slope * b;
    inside += weight * (normal_cdf((edge - middle) / sigma_a) - normal_cdf((-edge - middle) / sigma_a));
  }
  return std::clamp(1.0 - inside / total, 0.0, 1.0);
}

FootFit foot_fit(const Patch& foot, const Patch& ground) {
  const std::vector<Vector2d> points = spread(boundary(foot));
  std::vector<Clearance> all;
  for (const Vector2d& u : points) all.push_back(clearance(foot, ground, u));
  const auto [least, greatest] = std::ranges::minmax_element(all, {}, &Clearance::value);
  const PatchMatrix cov_foot = cov_local_or_zero(foot), cov_ground = cov_local_or_zero(ground);
  const auto sigma = [&](const PatchVector& J_foot, const PatchVector& J_ground) {
    return root(J_foot.dot(cov_foot * J_foot) + J_ground.dot(cov_ground * J_ground));
  };
  FootFit out;
  out.gap = {least->value, sigma(least->J_foot, least->J_ground)};
  out.rocking = {greatest->value - least->value,
                 sigma(greatest->J_foot - least->J_foot, greatest->J_ground - least->J_ground)};
  out.share =
      static_cast<double>(std::ranges::count(all, true, &Clearance::held)) / static_cast<double>(all.size());
  return out;
}

double distance_to(const Patch& patch, const Vector3d& point) {
  const Pose pose = world_from_patch(patch);
  const Vector3d q = apply_inverse(pose, point), kappa = k3(patch);
  const FootPoint nearest = foot_point(q, Matrix3d::Identity(), kappa);
  const Boundary bound = boundary(patch);
  if (contains(bound, nearest.x.head<2>()) && on_modelled_sheet(nearest.x, kappa))
    return std::abs(nearest.distance);
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2d& u : outline(bound, 100)) least = std::min(least, (surface_point(u, kappa) - q).norm());
  return least;
}

std::vector<NearPatch> patches_within(std::span<const Patch> patches, const Vector3d& point, double radius) {
  std::vector<NearPatch> out;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const double distance = distance_to(patches[i], point);
    if (distance <= radius) out.push_back({i, distance});
  }
  std::ranges::sort(out, {}, &NearPatch::distance);
  return out;
}

}  // namespace patchlab
