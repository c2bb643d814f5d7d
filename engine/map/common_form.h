// Surfaces of any type in forms that can be compared: free of the choice of axes and, where a surface slides
// in itself, of its apex.
//
// The 2-jet: the surface as a height over a plane, at one point of it: (h, s_x, s_y, H_xx, H_xy, H_yy),
// height (m), slopes (1) and second derivatives (1/m). Half turns, swapped axes, the order of curvatures, a
// plane beside a flat paraboloid, a sphere beside a circular paraboloid: all give the same jet where they are
// the same surface, so that none of these symmetries has to be tried.
//
// The quadric: the ten coefficients of f over that plane's frame, Eq. (37). Two patches of one type are the
// same surface exactly where these agree, everywhere and not at one point alone.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/patch/patch.h"

namespace patchlab {

// Coefficients of f(v) = v'A v + b'v + c: (A_xx, A_xy, A_xz, A_yy, A_yz, A_zz, b_x, b_y, b_z, c).
inline constexpr int quadric_size = 10;
inline constexpr int jet_size = 6;

// A form's value and how it moves with the patch: J_local by its local chart (d, kappa, w, t), and J_wt by a
// full rotation and translation (w, t) in the patch's axes, also of 5-DoF patches. Frame: plane_from_world.
template <int size>
struct CommonForm {
  Eigen::Matrix<double, size, 1> value;
  Eigen::Matrix<double, size, Eigen::Dynamic, 0, size, 11> J_local;
  Eigen::Matrix<double, size, 6> J_wt;
};
using SurfaceJet = CommonForm<jet_size>;
using SurfaceQuadric = CommonForm<quadric_size>;

// `world_from_plane`: its z is the direction of heights (along the normals, to within a right angle), its
// origin the point. Nothing where the line along z meets no sheet of the surface.
std::optional<SurfaceJet> surface_jet(const Patch& patch, const Pose& world_from_plane);
SurfaceQuadric surface_quadric(const Patch& patch, const Pose& world_from_plane);

// d (w, t) in the patch's axes in a / d (r, t) of a_from_b, of a patch that stands in a as it is given, Eq.
// (46).
Matrix6d J_wt_pose(const Pose& a_from_b, const Patch& patch_a);

// Covariance of the jet at u (m, in the patch's xy plane) that comes from curvature that the type of the
// patch cannot show: a plane fitted to an almost flat surface says nothing about how flat it is. For each
// component of the curvature tensor that the type leaves out, a fit with it would have had a variance that
// follows from the patch's own tilt variance and extent; what heights and slopes owe to it is carried along.
// Rows as the jet, in the patch's own axes. Zero without a covariance.
using CovJet = Eigen::Matrix<double, jet_size, jet_size>;
CovJet cov_unseen_curvature(const Patch& patch, const Vector2d& u);

// The local covariance; zero for a patch that is known exactly.
PatchMatrix cov_local_or_zero(const Patch& patch);

// The orthonormal frame at `point` whose z is `normal`; its x is as near as can be to `along`.
Pose plane_at(const Vector3d& point, const Vector3d& normal, const Vector3d& along);

}  // namespace patchlab
