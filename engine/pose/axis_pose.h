// The 5-DoF pose (r_xy, t) of Eqs. (6)-(8), (43), (45): the pose of a patch with a continuous rotation
// symmetry about its z axis. Threshold-free swing-twist form of errata section 4 (D1).
#pragma once

#include <Eigen/Core>

#include "engine/pose/pose.h"

namespace patchlab {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Matrix23d = Eigen::Matrix<double, 2, 3>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Matrix56d = Eigen::Matrix<double, 5, 6>;

// [r_xy; 0].
inline Vector3d lift(const Vector2d& r_xy) { return {r_xy.x(), r_xy.y(), 0.0}; }

// r_xy(r), Eq. (8): R([r_xy; 0]) z = R(r) z, |r_xy| <= pi.
Vector2d r_xy(const Vector3d& r);
// Eq. (45): d r_xy / d r. Its entries grow as pi / (pi - theta_xy) near theta_xy = pi, where it is singular.
Matrix23d J_r_xy_r(const Vector3d& r);

// E with cov_r_xy = E cov_tilt E', and its inverse: tilt is the rotation a about body x, y of R = R0 R([a;
// 0]), whose covariance never degenerates (errata section 4).
Matrix2d J_r_xy_tilt(const Vector2d& r_xy);
Matrix2d J_tilt_r_xy(const Vector2d& r_xy);

// True where the covariance of r_xy says little: pi - theta_xy < max(1e-6, 20 standard deviations of the
// tilt).
bool near_singular(const Vector2d& r_xy, const Matrix2d& cov_tilt);

// J5 of Eq. (43): d(r_xy, t)/d(r, t).
Matrix56d J_axis_pose(const Pose& pose);

}  // namespace patchlab
