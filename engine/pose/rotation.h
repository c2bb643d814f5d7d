// Rotations by the exponential map: Eqs. (2), (44), Appendix II, in the stable forms of errata 2 and 3.
//
// An orientation vector r (radian) stands for the rotation by |r| about r/|r|. Canonical: |r| <= pi.
// J_a_b is d a / d b; all Jacobians are 3x3, rows of a, columns of b.
#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/base/result.h"

namespace patchlab {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// [v]x, with [v]x w = v x w. Eq. (2), errata section 2.
Matrix3d skew(const Vector3d& v);

// R(r). Eq. (2). Any finite r; error below 2e-15.
Matrix3d exp_map(const Vector3d& r);

// r(R), canonical; by the unit quaternion (errata D2-D5). Precondition: R orthonormal to 1e-9, det +1.
// At |r| = pi exactly the component with the largest R_ii is positive.
Vector3d log_map(const Matrix3d& R);

// The shortest rotation that turns the direction of `from` into that of `to`; about some axis across them
// where they are opposite. Precondition: neither is zero.
Matrix3d shortest_turn(const Vector3d& from, const Vector3d& to);

// R as it should be: accepted when max|R'R - I| <= 1e-9, projected to the nearest up to 1e-3, else an error.
Result<Matrix3d> nearest_rotation(const Matrix3d& R);

// Jl(r): R(r + dr) = R(Jl dr) R(r) to first order. Jr(r) = Jl(-r): R(r + dr) = R(r) R(Jr dr).
Matrix3d left_jacobian(const Vector3d& r);
Matrix3d right_jacobian(const Vector3d& r);
// Their inverses; precondition |r| < 2 pi.
Matrix3d left_jacobian_inverse(const Vector3d& r);
Matrix3d right_jacobian_inverse(const Vector3d& r);

// dR/dr, slice k is dR/dr_k. Eq. (44).
std::array<Matrix3d, 3> J_R_r(const Vector3d& r);
// d(R(r) v)/dr and d(R(r)' v)/dr.
Matrix3d J_Rv_r(const Vector3d& r, const Vector3d& v);
Matrix3d J_Rtv_r(const Vector3d& r, const Vector3d& v);

// The same rotation as another vector, with the Jacobian that carries a covariance along (errata D9):
// cov_new = J cov_old J'.
struct Reparametrised {
  Vector3d r;
  Matrix3d J;
};
// Grassia's reparametrisation: |r| <= pi.
Reparametrised canonical(const Vector3d& r);
// The branch of r nearest to `reference` (errata section 3): before any difference, average or Kalman update.
Reparametrised nearest_branch(const Vector3d& r, const Vector3d& reference);

}  // namespace patchlab
