// The surfaces of Section III as one implicit form, Eqs. (12)-(16), (22)-(29), (37)-(41):
//
//   f(q) = q' K q - 2 z' q,  K = diag(k3),  k3 = B k
//
// in the local frame of the patch; B is what each type fixes in K (a column of Table I in
// engine/patch/patch_type.h). z is the outward normal at the apex; kappa > 0 is concave (bends towards +z),
// in 1/m. f < 0 on the outer side. Units: q in metre, k3 in 1/metre, f in metre.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/pose/pose.h"

namespace patchlab {

using Eigen::Vector2d;

// f, Eq. (37).
double implicit(const Vector3d& q_patch, const Vector3d& k3);
// g = (d f / d q)' = 2 (K q - z), Eq. (39). The outward unit normal at a point of the surface is -g/|g|.
Vector3d gradient(const Vector3d& q_patch, const Vector3d& k3);
Vector3d outward_normal(const Vector3d& q_patch, const Vector3d& k3);

// Derivatives of f_w(q_w) = f(X_r(q_w, r, c)), Eqs. (38)-(41), tensor-free forms of errata section 6.
struct SurfaceDerivatives {
  double f;                           // Eq. (38)
  Eigen::RowVector3d J_f_q;           // Eq. (39)
  Eigen::Matrix<double, 1, 9> J_f_p;  // Eq. (40): (k3, r, c)
  Eigen::Matrix<double, 3, 9> J_g_p;  // Eq. (41): rows of [df/dq_w]', columns (k3, r, c)
};
SurfaceDerivatives derivatives(const Vector3d& q_world, const Vector3d& k3, const Pose& world_from_patch);

// z(u), the explicit form (13), (23), (27): u = (x, y) in the local frame, m. For the sphere and the cylinder
// precondition |kappa| rho <= 1 (clamped), rho = |u| or |y|; stable form of errata section 5 (D6).
double height(const Vector2d& u, const Vector3d& k3);
// Derivatives of the height: dz/du (1x2) and dz/dk3 (1x3).
Eigen::RowVector2d J_height_u(const Vector2d& u, const Vector3d& k3);
Eigen::RowVector3d J_height_k3(const Vector2d& u, const Vector3d& k3);
// (u, z(u)).
Vector3d surface_point(const Vector2d& u, const Vector3d& k3);

// True where q lies on the modelled sheet: 0 <= kappa z <= 1 for the sphere and the cylinder (to a relative
// 1e-12), always for paraboloids and planes.
bool on_modelled_sheet(const Vector3d& q_patch, const Vector3d& k3);

// The hits of the ray origin + s direction, s > 0, with the modelled sheet, nearest first; not clipped by a
// boundary.
struct RayHits {
  int count = 0;
  double s[2] = {0.0, 0.0};
};
RayHits ray_hits(const Vector3d& origin_patch, const Vector3d& direction_patch, const Vector3d& k3);

// The foot point of q on the whole quadric (both halves of a sphere), the nearest point in the Mahalanobis
// metric of `cov` (method M2); with cov = I the Euclidean one. Converged to below 1e-9 m. `cov`
// may be semi-definite: where it lets q reach no point of the surface, x is q and the distance infinite
// (signed). Allocates nothing.
struct FootPoint {
  Vector3d x;       // on the surface
  double distance;  // signed: F = g(x)'(q - x) / sqrt(g' cov g)
  int iterations;
};
FootPoint foot_point(const Vector3d& q_patch, const Matrix3d& cov_patch, const Vector3d& k3);

}  // namespace patchlab
