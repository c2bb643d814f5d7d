// A bounded curved patch with its uncertainty: Section III, Table I.
//
// Parameters p = [d.., kappa.., r or r_xy, c] in the order of Table I; units metre, 1/metre, radian (gamma),
// radian, metre. `covariance` is of this additive vector in the same order. `covariance_local` is of the
// local chart (d, kappa, w, t), the same patch perturbed in its own axes:
//   d += dd,  kappa += dkappa,  R <- R R(w),  c <- c + R t
// with w = (w_x, w_y, w_z), or the tilt (w_x, w_y) of a 5-DoF patch, whose R is R([r_xy; 0]). It never
// degenerates, and the two are joined by J_parameters_local.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/patch/boundary.h"
#include "engine/patch/patch_type.h"
#include "engine/patch/surface.h"
#include "engine/pose/pose.h"

namespace patchlab {

using PatchVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 11, 1>;
using PatchMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 11, 11>;

struct Patch {
  const PatchTypeRow* type = nullptr;           // a row of Table I
  PatchVector parameters;                       // [d, kappa, r or r_xy, c]
  std::optional<PatchMatrix> covariance;        // same order; none for a designed patch
  std::optional<PatchMatrix> covariance_local;  // (d, kappa, w or tilt, t)
};

// Parts of the parameter vector.
Boundary boundary(const Patch& patch);
Eigen::VectorXd curvatures(const Patch& patch);  // kappa_x kappa_y | kappa | empty
Vector3d k3(const Patch& patch);                 // B k
Pose world_from_patch(const Patch& patch);       // (r, c); r = [r_xy; 0] for a 5-DoF patch
Matrix3d axes(const Patch& patch);               // R: columns x_l, y_l, z_l in the world
Vector3d centre(const Patch& patch);             // c

// A patch from its parts; `covariance_local` may be absent; the covariance of the parameters follows from it.
Patch make_patch(const PatchTypeRow& type, const Boundary& boundary, const Eigen::VectorXd& curvatures,
                 const Matrix3d& R, const Vector3d& c,
                 const std::optional<PatchMatrix>& covariance_local = std::nullopt);

// d p / d (local chart), square; and its inverse. Near theta_xy = pi of a 5-DoF patch it grows (errata D1).
PatchMatrix J_parameters_local(const Patch& patch);
PatchMatrix J_local_parameters(const Patch& patch);
// J cov J', exactly symmetric.
PatchMatrix carried(const PatchMatrix& J, const PatchMatrix& covariance);
// covariance_local, or where only `covariance` is present what follows from it.
std::optional<PatchMatrix> local_covariance(const Patch& patch);
// True where `covariance` says little about the orientation (engine/pose/axis_pose.h), of 5-DoF patches only.
bool near_singular(const Patch& patch);

// Nothing, or the reason why the parameters are no patch: sizes, finite, d > 0, |kappa| d <= 1 (sphere,
// cylinder), signs of the curvatures, a quad's degenerate diagonals (errata D11), 0 < gamma < pi/2, canonical
// r, covariance symmetric positive semi-definite.
Result<void> validate(const Patch& patch);

// True where the point lies on the patch's side of the boundary, and on the modelled sheet (by its z).
bool contains(const Patch& patch, const Vector3d& q_world);
// The ray's nearest hit with the bounded patch, q = origin + s direction in the world: s > 0, or nothing.
std::optional<double> ray_hit(const Patch& patch, const Vector3d& origin_world,
                              const Vector3d& direction_world);
// Area of the curved surface inside the boundary, m^2 (relative error below 1e-6).
double surface_area(const Patch& patch);

// The other descriptions of the same patch (errata section 5), parameters and both covariances carried along.
// z_l to the other side; kappa and u_y change sign.
Patch flip_normal(const Patch& patch);
// x' = y, y' = -x. Precondition: neither 5-DoF nor cylindric (kappa along y).
Patch swap_axes(const Patch& patch);
// R -> R Rz(pi), the residual symmetry of every 6-DoF patch.
Patch half_turn(const Patch& patch);
// The one description that the conventions ask for: |kappa_x| <= |kappa_y|, d_x >= d_y of planes,
// gamma <= pi/4, the half turn with the smaller |r|, r canonical; and z_l towards the viewpoint where one is
// given.
Patch conventional(const Patch& patch, const std::optional<Vector3d>& viewpoint = std::nullopt);

// The patch seen from another frame: a_from_b applied, the covariances carried along and that of the pose
// added where it is given (Eqs. (42), (43)).
Patch transform(const Pose& a_from_b, const Patch& patch_b);
Patch transform(const UncertainPose& a_from_b, const Patch& patch_b);

}  // namespace patchlab
