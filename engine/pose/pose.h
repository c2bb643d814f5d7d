// Poses (r, t) of Section II.B, Eqs. (1), (3)-(5), (11). r in radian, t in metre.
//
// A pose named a_from_b maps a point of frame b to frame a: q_a = R(r) q_b + t. Names cancel:
// q_world = apply(world_from_patch, q_patch).
// Covariances of poses are 6x6, of the additive vector (r, t), in that order.
#pragma once

#include <Eigen/Core>

#include "engine/pose/rotation.h"

namespace patchlab {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

struct Pose {
  Vector3d r = Vector3d::Zero();  // orientation vector, rad
  Vector3d t = Vector3d::Zero();  // translation, m

  Vector6d vector() const { return (Vector6d() << r, t).finished(); }
};

struct UncertainPose {
  Pose pose;
  Matrix6d covariance = Matrix6d::Zero();  // of (r, t)
};

// X_f, Eq. (3): q_a from q_b for pose a_from_b.
Vector3d apply(const Pose& a_from_b, const Vector3d& q_b);
// X_r, Eq. (4): q_b from q_a for pose a_from_b.
Vector3d apply_inverse(const Pose& a_from_b, const Vector3d& q_a);

// Derivatives of X_f and X_r.
struct PointJacobians {
  Matrix3d J_q, J_r, J_t;
};
PointJacobians J_apply(const Pose& a_from_b, const Vector3d& q_b);
PointJacobians J_apply_inverse(const Pose& a_from_b, const Vector3d& q_a);  // Eq. (11)

// Eq. (5) and its 6x6 Jacobian.
Pose inverse(const Pose& pose);
Matrix6d J_inverse(const Pose& pose);
UncertainPose inverse(const UncertainPose& pose);

// |r| <= pi, the covariance carried along (errata D9).
UncertainPose canonical(const UncertainPose& pose);

// x = first second: a_from_c = compose(a_from_b, b_from_c), r canonical.
Pose compose(const Pose& a_from_b, const Pose& b_from_c);

// First-order conversions between the covariance of the additive (r, t) and those of others (errata section
// 8). G with cov_xi = G cov_rt G'.
Matrix6d right_rot_trans_from_rt(const Pose& pose);  // T = Tbar Exp(xi), xi = (rotation, translation): GTSAM
Matrix6d left_rot_trans_from_rt(const Pose& pose);   // T = Exp(xi) Tbar
Matrix6d ros_fixed_axes_from_rt(const Pose& pose);   // (translation, rotation about fixed parent axes): ROS

}  // namespace patchlab
