#include "engine/patch/patch.h"

namespace patchlab {
namespace {

// d (w, t) in the patch's axes in a / d (r, t) of a_from_b: a rotation dr of the pose turns the patch by Jl
// dr about the origin of a_from_b, Eqs. (42), (46).
Eigen::Matrix<double, 6, 6> J_chart_pose(const Pose& a_from_b, const Matrix3d& R_a, const Vector3d& c_b) {
  const Matrix3d R_a_t = R_a.transpose(), Jl = left_jacobian(a_from_b.r);
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_a_t * Jl;
  J.bottomLeftCorner<3, 3>() = R_a_t * J_Rv_r(a_from_b.r, c_b);
  J.bottomRightCorner<3, 3>() = R_a_t;
  return J;
}

Patch moved(const Pose& a_from_b, const Patch& patch_b, const std::optional<PatchMatrix>& covariance_local) {
  return make_patch(*patch_b.type, boundary(patch_b), curvatures(patch_b),
                    exp_map(a_from_b.r) * axes(patch_b), apply(a_from_b, centre(patch_b)), covariance_local);
}

}  // namespace

Patch transform(const Pose& a_from_b, const Patch& patch_b) {
  return moved(a_from_b, patch_b, local_covariance(patch_b));
}

Patch transform(const UncertainPose& a_from_b, const Patch& patch_b) {
  const PatchTypeRow& type = *patch_b.type;
  const Matrix3d R_a = exp_map(a_from_b.pose.r) * axes(patch_b);
  const Matrix6d J_wt = J_chart_pose(a_from_b.pose, R_a, centre(patch_b));
  PatchMatrix J = PatchMatrix::Zero(type.size(), 6);
  J.middleRows(type.rotation_at(), type.rotation_size) = J_wt.topRows(type.rotation_size);
  J.bottomRows<3>() = J_wt.bottomRows<3>();
  PatchMatrix covariance = carried(J, a_from_b.covariance);
  if (const auto own = local_covariance(patch_b)) covariance += *own;
  return moved(a_from_b.pose, patch_b, covariance);
}

}  // namespace patchlab
