#include "engine/map/touch.h"

#include "engine/base/chi_square.h"
#include "engine/map/common_form.h"
#include "engine/map/correct.h"
#include "engine/map/joint_update.h"

namespace patchlab {
namespace {

Error beside() {
  return {ErrorCode::usage,
          "The contact is beside the patch: no sheet of its surface lies there along its normal."};
}

Result<Touched> updated(const Patch& patch, const Eigen::VectorXd& y, const Eigen::MatrixXd& H,
                        const Eigen::MatrixXd& R, const Pose& plane) {
  const auto cov = local_covariance(patch);
  if (!cov)
    return Error{ErrorCode::usage,
                 "A designed patch without a covariance is known exactly; a contact cannot change it."};
  Measurement m{bounds_apart(*patch.type, *cov),    y, H,
                Eigen::MatrixXd::Zero(y.size(), 6), R, Eigen::MatrixXd::Zero(patch.type->size(), 6)};
  const JointUpdate update = update_jointly({m}, {});
  Touched out{corrected(patch, update.patches[0].x, update.patches[0].P, plane), update.chi2, update.dof,
              0.0};
  out.p_value = chi_square_p_value(out.chi2, out.dof);
  return out;
}

// The outward normal of the surface nearest to the point.
Vector3d normal_near(const Patch& patch, const Vector3d& point) {
  const Vector3d q = apply_inverse(world_from_patch(patch), point), kappa = k3(patch);
  return axes(patch) * outward_normal(foot_point(q, Matrix3d::Identity(), kappa).x, kappa);
}

}  // namespace

Result<Touched> touched_at(const Patch& patch, const Vector3d& point, const Matrix3d& cov_point) {
  const Vector3d n = normal_near(patch, point);
  const Pose plane = plane_at(point, n, axes(patch).col(0));
  const auto jet = surface_jet(patch, plane);
  if (!jet) return beside();
  return updated(patch, -jet->value.head<1>(), jet->J_local.topRows<1>(),
                 Eigen::MatrixXd::Constant(1, 1, n.dot(cov_point * n)), plane);
}

Result<Touched> touched_by(const Patch& patch, const Patch& contact) {
  if (contact.type->surface != SurfaceType::plane) {
    return Error{ErrorCode::usage, "A contact is a point or a plane; this one is a " +
                                       std::string(name(contact.type->surface)) + "."};
  }
  const Vector3d n = normal_near(patch, centre(contact));
  const Patch facing = axes(contact).col(2).dot(n) < 0.0 ? flip_normal(contact) : contact;
  const Pose plane = plane_at(centre(facing), n, axes(patch).col(0));
  const auto of_patch = surface_jet(patch, plane), of_contact = surface_jet(facing, plane);
  if (!of_patch || !of_contact) return beside();
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  if (const auto cov = local_covariance(facing)) {
    R = of_contact->J_local.topRows<3>() * *cov * of_contact->J_local.topRows<3>().transpose();
  }
  return updated(patch, (of_contact->value - of_patch->value).head<3>(), of_patch->J_local.topRows<3>(), R,
                 plane);
}

}  // namespace patchlab
