#include "engine/fit/paper_steps.h"

#include <algorithm>
#include <cmath>

#include "engine/pose/axis_pose.h"

namespace patchlab {
namespace {

constexpr double epsilon_k = 0.1;  // 1/m: step 3's small threshold

SurfaceFitOptions as_printed(const Workbench& work) {
  SurfaceFitOptions options;
  options.distance = Distance::paper;
  options.robust = work.options.robust;
  options.solver.max_iterations = 500;
  return options;
}

// The frame R([r_xy; 0]) with this normal, Eq. (8).
Matrix3d frame_of_r_xy(const Matrix3d& R) { return exp_map(lift(r_xy(log_map(R)))); }

bool is_paraboloid(SurfaceRequest request) {
  using enum SurfaceRequest;
  return request == paraboloid || request == elliptic_paraboloid || request == hyperbolic_paraboloid ||
         request == cylindric_paraboloid || request == circular_paraboloid;
}

std::vector<ModelKind> printed_models(SurfaceRequest request) {
  switch (request) {
    case SurfaceRequest::automatic:
      return {ModelKind::paraboloid, ModelKind::sphere, ModelKind::circular_cylinder};
    case SurfaceRequest::plane:
      return {ModelKind::plane};
    case SurfaceRequest::sphere:
      return {ModelKind::sphere};
    case SurfaceRequest::circular_cylinder:
      return {ModelKind::circular_cylinder};
    default:
      return {ModelKind::paraboloid};
  }
}

// The same surface with x and y exchanged, its normal matrix taken anew.
void swap_axes(Workbench& work) {
  SurfaceState& state = work.surface.state;
  const Vector3d x = state.R.col(0);
  state.R.col(0) = state.R.col(1);
  state.R.col(1) = -x;
  std::swap(state.k[0], state.k[1]);
  SurfaceFitOptions options = as_printed(work);
  options.solver.max_iterations = 0;
  const SurfaceFit evaluated = fit_surface(work.samples, work.surface.model, state, options);
  work.surface.A = evaluated.A;
}

// Which of Table I's paraboloids the two fitted curvatures are.
SurfaceType by_threshold(const Vector2d& k) {
  const double x = std::abs(k[0]), y = std::abs(k[1]);
  if (std::max(x, y) < epsilon_k) return SurfaceType::plane;
  if (std::min(x, y) < epsilon_k) return SurfaceType::cylindric_paraboloid;
  if (std::abs(k[0] - k[1]) < epsilon_k) return SurfaceType::circular_paraboloid;
  return k[0] * k[1] > 0.0 ? SurfaceType::elliptic_paraboloid : SurfaceType::hyperbolic_paraboloid;
}

SurfaceType printed_type(const Workbench& work) {
  switch (work.options.surface) {
    case SurfaceRequest::elliptic_paraboloid:
    case SurfaceRequest::hyperbolic_paraboloid:
      return surface_type(work.surface);
    case SurfaceRequest::cylindric_paraboloid:
      return SurfaceType::cylindric_paraboloid;
    case SurfaceRequest::circular_paraboloid:
      return SurfaceType::circular_paraboloid;
    default:
      return by_threshold(work.surface.state.k);
  }
}

}  // namespace

void paper_plane(Workbench& work) {
  work.plane = initial_plane(work.samples);
  work.plane.R = frame_of_r_xy(work.plane.R);
  if (is_paraboloid(work.options.surface)) return;
  const SurfaceModel& plane = surface_model(ModelKind::plane);
  work.plane_fit = fit_surface(work.samples, plane, work.plane, as_printed(work));
  const int iterations = work.plane_fit.iterations;
  SurfaceState& state = work.plane_fit.state;
  state.R = frame_of_r_xy(state.R);
  const Vector3d z = state.R.col(2);
  state.c = z * z.dot(state.c);  // step 1 (ii): the mean is the origin
  work.plane_fit = fit_surface(work.samples, plane, state, as_printed(work));
  work.plane_fit.iterations = iterations;
  work.plane = work.plane_fit.state;
}

void paper_surfaces(Workbench& work) {
  for (const ModelKind kind : printed_models(work.options.surface)) {
    work.fits.push_back(kind == ModelKind::plane
                            ? work.plane_fit
                            : fit_surface(work.samples, surface_model(kind), work.plane, as_printed(work)));
  }
}

void paper_type(Workbench& work) {
  work.choice = choose(work.fits, work.samples.size());
  work.surface = work.fits[work.choice.best];
  work.surface_type = work.surface.model.surface;
  if (work.surface.model.kind != ModelKind::paraboloid) return;
  if (std::abs(work.surface.state.k[0]) > std::abs(work.surface.state.k[1])) swap_axes(work);
  work.surface_type = printed_type(work);
  if (work.surface_type == SurfaceType::cylindric_paraboloid) {
    work.plan.curvatures = Eigen::RowVector2d(0.0, 1.0);
  } else if (work.surface_type == SurfaceType::circular_paraboloid) {
    work.plan.curvatures = Eigen::RowVector2d(0.5, 0.5);
  }
}

}  // namespace patchlab
