// Chains of uncertain poses: Eqs. (9), (10), (42), (43), (46) in the O(n) form of errata section 7.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/pose/axis_pose.h"

namespace patchlab {

// One element (r_j, t_j)^phi_j. phi = +1: the pose maps the end side to the base side; -1: its inverse is
// used. The covariance is of the stored (r_j, t_j), also where phi is -1. |r_j| > pi is allowed.
struct ChainElement {
  UncertainPose pose;
  int phi = +1;
};

// Elements stand from the base to the end: n ... 1 of Eq. (9), left to right.
using Chain = std::vector<ChainElement>;

// (r_c, t_c) of Eq. (10), r_c canonical.
Pose chain_pose(const Chain& chain);
// J_c of Eq. (46): 6 x 6n, column blocks in the order of the elements (n ... 1).
Eigen::Matrix<double, 6, Eigen::Dynamic> J_chain(const Chain& chain);
// Pose and Sigma_c of Eq. (42); symmetric. Assumes independent elements: the same uncertain pose twice is not
// covered.
UncertainPose compose(const Chain& chain);

// The pose of a 5-DoF patch at the end of the chain, Eq. (43).
struct UncertainAxisPose {
  Vector2d r_xy = Vector2d::Zero();
  Vector3d t = Vector3d::Zero();
  Matrix5d covariance = Matrix5d::Zero();  // of (r_xy, t)
  Matrix2d cov_tilt = Matrix2d::Zero();    // of the body tilt: valid where near_singular is true
  bool near_singular = false;
};
UncertainAxisPose axis_pose(const UncertainPose& pose);

}  // namespace patchlab
