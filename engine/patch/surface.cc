#include "engine/patch/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace patchlab {
namespace {

double k_rho2(const Vector2d& u, const Vector3d& k3) {
  return k3.x() * u.x() * u.x() + k3.y() * u.y() * u.y();
}

// 1 - kappa z on the surface above u: the z component of the outward normal -g/2. 1 for paraboloids.
double slope_root(const Vector2d& u, const Vector3d& k3) {
  const double a2 = k3.z() * k_rho2(u, k3);
  if (a2 <= 0.0) return std::sqrt(1.0 - a2);
  const double a = std::sqrt(a2);
  return std::sqrt(std::max(0.0, 1.0 - a) * (1.0 + a));  // errata D6
}

}  // namespace

double implicit(const Vector3d& q_patch, const Vector3d& k3) {
  return q_patch.dot(k3.cwiseProduct(q_patch)) - 2.0 * q_patch.z();  // Eq. (37)
}

Vector3d gradient(const Vector3d& q_patch, const Vector3d& k3) {
  return 2.0 * (k3.cwiseProduct(q_patch) - Vector3d::UnitZ());  // Eq. (39)
}

Vector3d outward_normal(const Vector3d& q_patch, const Vector3d& k3) {
  return -gradient(q_patch, k3).normalized();
}

SurfaceDerivatives derivatives(const Vector3d& q_world, const Vector3d& k3, const Pose& world_from_patch) {
  const Matrix3d R = exp_map(world_from_patch.r), Jl = left_jacobian(world_from_patch.r);
  const Vector3d y = q_world - world_from_patch.t, q = R.transpose() * y;
  const Vector3d n = R * gradient(q, k3);
  const Matrix3d RKRt = R * k3.asDiagonal() * R.transpose();
  SurfaceDerivatives d;
  d.f = implicit(q, k3);                                                                    // Eq. (38)
  d.J_f_q = n.transpose();                                                                  // Eq. (39)
  d.J_f_p << q.cwiseProduct(q).transpose(), n.cross(y).transpose() * Jl, -d.J_f_q;          // Eq. (40)
  d.J_g_p << 2.0 * R * q.asDiagonal(), (2.0 * RKRt * skew(y) - skew(n)) * Jl, -2.0 * RKRt;  // Eq. (41)
  return d;
}

double height(const Vector2d& u, const Vector3d& k3) {
  return k_rho2(u, k3) / (1.0 + slope_root(u, k3));  // Eqs. (13), (23), (27), errata section 5
}

Eigen::RowVector2d J_height_u(const Vector2d& u, const Vector3d& k3) {
  return k3.head<2>().cwiseProduct(u).transpose() / slope_root(u, k3);
}

Eigen::RowVector3d J_height_k3(const Vector2d& u, const Vector3d& k3) {
  const Vector3d q = surface_point(u, k3);
  return q.cwiseProduct(q).transpose() / (2.0 * slope_root(u, k3));
}

Vector3d surface_point(const Vector2d& u, const Vector3d& k3) { return {u.x(), u.y(), height(u, k3)}; }

bool on_modelled_sheet(const Vector3d& q_patch, const Vector3d& k3) {
  constexpr double slack = 1e-12;
  const double kappa_z = k3.z() * q_patch.z();
  return kappa_z >= -slack && kappa_z <= 1.0 + slack;  // Eqs. (22), (26)
}

RayHits ray_hits(const Vector3d& origin_patch, const Vector3d& direction_patch, const Vector3d& k3) {
  // f(origin + s direction) = a s^2 + 2 b s + c; the two roots are -m/a and -c/m.
  const double a = direction_patch.dot(k3.cwiseProduct(direction_patch));
  const double b = 0.5 * gradient(origin_patch, k3).dot(direction_patch);
  const double c = implicit(origin_patch, k3);
  RayHits hits;
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0.0)) return hits;
  const double m = b + std::copysign(std::sqrt(discriminant), b);
  for (const double s : {-m / a, -c / m}) {
    if (!(s > 0.0) || !std::isfinite(s)) continue;
    if (on_modelled_sheet(origin_patch + s * direction_patch, k3)) hits.s[hits.count++] = s;
  }
  if (hits.count == 2 && hits.s[0] > hits.s[1]) std::swap(hits.s[0], hits.s[1]);
  return hits;
}

}  // namespace patchlab
