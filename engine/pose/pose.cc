#include "engine/pose/pose.h"

namespace patchlab {
namespace {

// J cov J', exactly symmetric.
Matrix6d carried(const Matrix6d& J, const Matrix6d& cov) {
  const Matrix6d out = J * cov * J.transpose();
  return 0.5 * (out + out.transpose());
}

}  // namespace

Vector3d apply(const Pose& a_from_b, const Vector3d& q_b) {
  return exp_map(a_from_b.r) * q_b + a_from_b.t;  // Eq. (3)
}

Vector3d apply_inverse(const Pose& a_from_b, const Vector3d& q_a) {
  return exp_map(a_from_b.r).transpose() * (q_a - a_from_b.t);  // Eq. (4)
}

PointJacobians J_apply(const Pose& a_from_b, const Vector3d& q_b) {
  return {exp_map(a_from_b.r), J_Rv_r(a_from_b.r, q_b), Matrix3d::Identity()};
}

PointJacobians J_apply_inverse(const Pose& a_from_b, const Vector3d& q_a) {
  const Matrix3d Rt = exp_map(a_from_b.r).transpose();
  return {Rt, J_Rtv_r(a_from_b.r, q_a - a_from_b.t), -Rt};  // Eq. (11)
}

Pose inverse(const Pose& pose) {
  return {-pose.r, -(exp_map(pose.r).transpose() * pose.t)};  // Eq. (5)
}

Matrix6d J_inverse(const Pose& pose) {
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = -Matrix3d::Identity();
  J.bottomLeftCorner<3, 3>() = -J_Rtv_r(pose.r, pose.t);
  J.bottomRightCorner<3, 3>() = -exp_map(pose.r).transpose();
  return J;
}

UncertainPose inverse(const UncertainPose& pose) {
  return {inverse(pose.pose), carried(J_inverse(pose.pose), pose.covariance)};
}

UncertainPose canonical(const UncertainPose& pose) {
  const Reparametrised rotation = canonical(pose.pose.r);
  Matrix6d J = Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = rotation.J;  // errata D9
  return {{rotation.r, pose.pose.t}, carried(J, pose.covariance)};
}

Pose compose(const Pose& a_from_b, const Pose& b_from_c) {
  return {log_map(exp_map(a_from_b.r) * exp_map(b_from_c.r)), apply(a_from_b, b_from_c.t)};
}

Matrix6d right_rot_trans_from_rt(const Pose& pose) {
  Matrix6d G = Matrix6d::Zero();
  G.topLeftCorner<3, 3>() = right_jacobian(pose.r);
  G.bottomRightCorner<3, 3>() = exp_map(pose.r).transpose();
  return G;
}

Matrix6d left_rot_trans_from_rt(const Pose& pose) {
  Matrix6d G = Matrix6d::Identity();
  G.topLeftCorner<3, 3>() = left_jacobian(pose.r);
  G.bottomLeftCorner<3, 3>() = skew(pose.t) * left_jacobian(pose.r);
  return G;
}

Matrix6d ros_fixed_axes_from_rt(const Pose& pose) {
  Matrix6d G = Matrix6d::Zero();
  G.topRightCorner<3, 3>() = Matrix3d::Identity();
  G.bottomLeftCorner<3, 3>() = left_jacobian(pose.r);
  return G;
}

}  // namespace patchlab
