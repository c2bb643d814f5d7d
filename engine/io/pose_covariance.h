// The 6x6 covariance of a patch's pose in the conventions of others, by name (errata section 8). Each follows
// from covariance_local by a linear map that is never singular. The spin of a 5-DoF patch about z_l, which no
// measurement tells, gets `spin_variance`: the matrix is positive definite and says that it is unknown.
#pragma once

#include <span>
#include <string_view>

#include "engine/patch/patch.h"

namespace patchlab {

// Variance that stands for "spin about z_l unknown" where a covariance is demanded: an angle uniform in (-pi,
// pi).
inline constexpr double spin_variance = 3.2898681336964528729;  // pi^2/3, rad^2

// Precondition of all: patch.covariance_local is present.
//
// T = Tbar Exp(xi), xi = (rotation, translation) along the patch's own axes: Pose3 of GTSAM.
Matrix6d right_rot_trans_covariance(const Patch& patch);
// T = Exp(xi) Tbar, xi = (rotation, translation) in the frame that the patch stands in.
Matrix6d left_rot_trans_covariance(const Patch& patch);
// (position, rotation about fixed parent axes), the order of ROS PoseWithCovariance.
Matrix6d ros_fixed_axes_covariance(const Patch& patch);

struct PoseCovariance {
  std::string_view name;
  Matrix6d (*of)(const Patch& patch);
};
std::span<const PoseCovariance> pose_covariances();
// Null for an unknown name.
const PoseCovariance* find_pose_covariance(std::string_view name);

}  // namespace patchlab
