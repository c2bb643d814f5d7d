#include "engine/io/pose_covariance.h"

#include <algorithm>

namespace patchlab {
namespace {

constexpr PoseCovariance conventions[] = {
    {"right_rot_trans", right_rot_trans_covariance},
    {"left_rot_trans", left_rot_trans_covariance},
    {"ros_fixed_axes", ros_fixed_axes_covariance},
};

Matrix6d symmetric(const Matrix6d& J, const Matrix6d& covariance) {
  const Matrix6d carried = J * covariance * J.transpose();
  return 0.5 * (carried + carried.transpose());
}

}  // namespace

Matrix6d right_rot_trans_covariance(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  const PatchMatrix& local = *patch.covariance_local;
  const int tilts = type.rotation_size, rotation = type.rotation_at(), position = type.position_at();
  Matrix6d cov = Matrix6d::Zero();  // R <- R R(w), c <- c + R t: xi = (w, t)
  cov.topLeftCorner(tilts, tilts) = local.block(rotation, rotation, tilts, tilts);
  cov.bottomRightCorner<3, 3>() = local.bottomRightCorner(3, 3);
  cov.topRightCorner(tilts, 3) = local.block(rotation, position, tilts, 3);
  cov.block(3, 0, 3, tilts) = local.block(position, rotation, 3, tilts);
  if (type.revolute()) cov(2, 2) = spin_variance;
  return 0.5 * (cov + cov.transpose());
}

Matrix6d left_rot_trans_covariance(const Patch& patch) {
  const Matrix3d R = axes(patch);
  Matrix6d J_left_right = Matrix6d::Zero();  // Ad_T
  J_left_right.topLeftCorner<3, 3>() = J_left_right.bottomRightCorner<3, 3>() = R;
  J_left_right.bottomLeftCorner<3, 3>() = skew(centre(patch)) * R;
  return symmetric(J_left_right, right_rot_trans_covariance(patch));
}

Matrix6d ros_fixed_axes_covariance(const Patch& patch) {
  Matrix6d J_ros_right = Matrix6d::Zero();
  J_ros_right.topRightCorner<3, 3>() = J_ros_right.bottomLeftCorner<3, 3>() = axes(patch);
  return symmetric(J_ros_right, right_rot_trans_covariance(patch));
}

std::span<const PoseCovariance> pose_covariances() { return conventions; }

const PoseCovariance* find_pose_covariance(std::string_view name) {
  const auto found = std::ranges::find(conventions, name, &PoseCovariance::name);
  return found == std::end(conventions) ? nullptr : &*found;
}

}  // namespace patchlab
