#include "engine/patch/patch.h"

#include <cmath>

namespace patchlab {
namespace {

Vector3d orientation_vector(const Patch& patch) {
  const int at = patch.type->rotation_at();
  if (patch.type->revolute()) return lift(patch.parameters.segment<2>(at));
  return patch.parameters.segment<3>(at);
}

// The spin of a revolute patch's axes R about z relative to those of R([r_xy; 0]) turns the local chart.
PatchMatrix J_spin(const PatchTypeRow& type, const Matrix3d& spin) {
  PatchMatrix J = PatchMatrix::Identity(type.size(), type.size());
  J.block<2, 2>(type.rotation_at(), type.rotation_at()) = spin.topLeftCorner<2, 2>();
  J.block<3, 3>(type.position_at(), type.position_at()) = spin;
  return J;
}

}  // namespace

PatchMatrix carried(const PatchMatrix& J, const PatchMatrix& covariance) {
  const PatchMatrix out = J * covariance * J.transpose();
  return 0.5 * (out + out.transpose());
}

Boundary boundary(const Patch& patch) {
  return {patch.type->boundary, patch.parameters.head(patch.type->boundary_size)};
}

Eigen::VectorXd curvatures(const Patch& patch) {
  return patch.parameters.segment(patch.type->curvature_at(), patch.type->curvature_size);
}

Vector3d k3(const Patch& patch) {
  return patch.type->B * patch.parameters.segment(patch.type->curvature_at(), patch.type->curvature_size);
}

Pose world_from_patch(const Patch& patch) { return {orientation_vector(patch), centre(patch)}; }

Matrix3d axes(const Patch& patch) { return exp_map(orientation_vector(patch)); }

Vector3d centre(const Patch& patch) { return patch.parameters.segment<3>(patch.type->position_at()); }

Patch make_patch(const PatchTypeRow& type, const Boundary& boundary, const Eigen::VectorXd& curvatures,
                 const Matrix3d& R, const Vector3d& c, const std::optional<PatchMatrix>& covariance_local) {
  const Vector3d r = log_map(R);
  Patch patch;
  patch.type = &type;
  patch.parameters.resize(type.size());
  patch.parameters.head(type.boundary_size) = boundary.d;
  patch.parameters.segment(type.curvature_at(), type.curvature_size) = curvatures;
  if (type.revolute()) {
    patch.parameters.segment<2>(type.rotation_at()) = r_xy(r);
  } else {
    patch.parameters.segment<3>(type.rotation_at()) = r;
  }
  patch.parameters.tail<3>() = c;
  if (!covariance_local) return patch;
  patch.covariance_local = *covariance_local;
  if (type.revolute())
    patch.covariance_local = carried(J_spin(type, axes(patch).transpose() * R), *covariance_local);
  patch.covariance = carried(J_parameters_local(patch), *patch.covariance_local);
  return patch;
}

PatchMatrix J_parameters_local(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  const Vector3d r = orientation_vector(patch);
  PatchMatrix J = PatchMatrix::Identity(type.size(), type.size());
  if (type.revolute()) {
    J.block<2, 2>(type.rotation_at(), type.rotation_at()) = J_r_xy_tilt(r.head<2>());
  } else {
    J.block<3, 3>(type.rotation_at(), type.rotation_at()) = right_jacobian_inverse(r);
  }
  J.block<3, 3>(type.position_at(), type.position_at()) = exp_map(r);
  return J;
}

PatchMatrix J_local_parameters(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  const Vector3d r = orientation_vector(patch);
  PatchMatrix J = PatchMatrix::Identity(type.size(), type.size());
  if (type.revolute()) {
    J.block<2, 2>(type.rotation_at(), type.rotation_at()) = J_tilt_r_xy(r.head<2>());
  } else {
    J.block<3, 3>(type.rotation_at(), type.rotation_at()) = right_jacobian(r);
  }
  J.block<3, 3>(type.position_at(), type.position_at()) = exp_map(r).transpose();
  return J;
}

std::optional<PatchMatrix> local_covariance(const Patch& patch) {
  if (patch.covariance_local || !patch.covariance) return patch.covariance_local;
  return carried(J_local_parameters(patch), *patch.covariance);
}

bool near_singular(const Patch& patch) {
  if (!patch.type->revolute()) return false;
  const int at = patch.type->rotation_at();
  Matrix2d cov_tilt = Matrix2d::Zero();
  if (const auto cov = local_covariance(patch)) cov_tilt = cov->block<2, 2>(at, at);
  return near_singular(patch.parameters.segment<2>(at), cov_tilt);
}

bool contains(const Patch& patch, const Vector3d& q_world) {
  const Vector3d q_patch = apply_inverse(world_from_patch(patch), q_world);
  return contains(boundary(patch), q_patch.head<2>()) && on_modelled_sheet(q_patch, k3(patch));
}

std::optional<double> ray_hit(const Patch& patch, const Vector3d& origin_world,
                              const Vector3d& direction_world) {
  const Vector3d origin = apply_inverse(world_from_patch(patch), origin_world);
  const Vector3d direction = axes(patch).transpose() * direction_world;
  const RayHits hits = ray_hits(origin, direction, k3(patch));
  const Boundary bound = boundary(patch);
  for (int i = 0; i < hits.count; ++i) {
    const Vector3d q = origin + hits.s[i] * direction;
    if (contains(bound, q.head<2>())) return hits.s[i];
  }
  return std::nullopt;
}

}  // namespace patchlab
