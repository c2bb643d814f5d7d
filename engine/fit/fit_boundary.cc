#include "engine/fit/fit_boundary.h"

#include <array>
#include <cmath>

#include "engine/base/chi_square.h"
#include "engine/fit/place.h"

namespace patchlab {
namespace {

Ingredients ingredients(const SurfaceFit& fit, const MomentVector& m, const PatchPlan& plan,
                        const SurfaceFit* plane) {
  Ingredients from;
  from.R = fit.state.R;
  from.kappa = constant(0.0);
  if (plan.type->curvature_size > 0) {
    for (int i = 0; i < 2; ++i) from.kappa += plan.curvatures(0, i) * variable(fit.state.k[i], i);
  }
  std::array<Dual, moments_size> dual;
  for (int i = 0; i < moments_size; ++i) dual[static_cast<std::size_t>(i)] = variable(m[i], moments_at + i);
  for (int i = 0; i < 3; ++i) {
    from.w[i] = variable(0.0, 2 + i);
    from.t[i] = variable(0.0, 5 + i);
    from.mean[i] = dual[static_cast<std::size_t>(i)];
  }
  from.second << dual[3], dual[4], dual[5], dual[4], dual[6], dual[7], dual[5], dual[7], dual[8];
  if (plane != nullptr) {
    const Dual3 tilt = {variable(0.0, plane_at), variable(0.0, plane_at + 1), constant(0.0)};
    const Dual3 z = constant(Vector3d::UnitZ());
    from.plane_normal = turned(fit.state.R.transpose() * plane->state.R, sum(z, cross(tilt, z)));
  }
  return from;
}

// From the moving axes of the surface to its axes at rest: R(w) v, and R(w) c + t.
void carry_along(Placed& placed, const Ingredients& from) {
  for (Dual3* axis : {&placed.x, &placed.y, &placed.z}) *axis = sum(*axis, cross(from.w, *axis));
  placed.c = sum(sum(placed.c, cross(from.w, placed.c)), from.t);
}

// d (d, k, w or tilt, t) / d (everything): a new frame from unit vectors (method M8).
JointRows J_local(const Placed& placed, const PatchPlan& plan) {
  const PatchTypeRow& type = *plan.type;
  JointRows J = JointRows::Zero(type.size(), joint_size);
  for (int i = 0; i < type.boundary_size; ++i) J.row(i) = placed.d[i].derivatives().transpose();
  J.block(type.curvature_at(), 0, type.curvature_size, 2) = plan.curvatures.topRows(type.curvature_size);
  const Vector3d x = value(placed.x), y = value(placed.y), z = value(placed.z);
  J.row(type.rotation_at()) = -y.transpose() * slope(placed.z);
  J.row(type.rotation_at() + 1) = x.transpose() * slope(placed.z);
  if (!type.revolute()) J.row(type.rotation_at() + 2) = y.transpose() * slope(placed.x);
  const Matrix3d axes = (Matrix3d() << x, y, z).finished();
  J.middleRows(type.position_at(), 3) = axes.transpose() * slope(placed.c);
  return J;
}

}  // namespace

BoundaryScale extent_scale(double containment) {
  const double ellipse = 2.0 * std::sqrt(containment), rectangle = std::sqrt(3.0 * containment);
  return {.ellipse = ellipse,
          .circle = ellipse,
          .rectangle = rectangle,
          .plane_ellipse = ellipse,
          .plane_circle = ellipse,
          .plane_rectangle = rectangle};
}

BoundaryScale paper_scale(double containment) {
  const double lambda = two_sided_normal_quantile(containment);  // step 4
  const double l = std::sqrt(-2.0 * std::log1p(-containment));   // Eq. (30)
  return {.ellipse = lambda,
          .circle = lambda,
          .rectangle = lambda,
          .plane_ellipse = l,
          .plane_circle = l,
          .plane_rectangle = l,
          .larger_axis = true};
}

Patch bounded_patch(const Samples& samples, const SurfaceFit& fit, const MomentVector& moments,
                    const JointCovariance& cov_joint, const PatchPlan& plan, const SurfaceFit* plane) {
  const PatchTypeRow& type = *plan.type;
  const Ingredients from = ingredients(fit, moments, plan, plane);
  Placed placed = place(from, plan);
  carry_along(placed, from);
  const JointRows J = J_local(placed, plan);
  PatchMatrix cov_local = cov_joint.of(J);
  if (plan.direction) cov_local(type.rotation_at() + 2, type.rotation_at() + 2) += plan.direction->variance;
  Boundary bound{type.boundary, BoundaryVector(type.boundary_size)};
  for (int i = 0; i < type.boundary_size; ++i) bound.d[i] = placed.d[i].value();
  const Eigen::VectorXd k = plan.curvatures.topRows(type.curvature_size) * fit.state.k;
  const Matrix3d axes = (Matrix3d() << value(placed.x), value(placed.y), value(placed.z)).finished();
  const Vector3d c = samples.origin + fit.state.c + fit.state.R * value(placed.c);
  return make_patch(type, bound, k, fit.state.R * axes, c, cov_local);
}

std::optional<Clamped> clamp_to_surface(Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  if (type.surface != SurfaceType::sphere && type.surface != SurfaceType::circular_cylinder)
    return std::nullopt;
  double& d = patch.parameters[type.boundary_size - 1];  // d of the circle, d_y across the cylinder's axis
  const Clamped clamped{d, 1.0 / std::abs(patch.parameters[type.curvature_at()])};
  if (!(clamped.d > clamped.limit)) return std::nullopt;
  d = clamped.limit;
  return clamped;
}

}  // namespace patchlab
