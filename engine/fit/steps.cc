#include "engine/fit/steps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/fit/choose_outline.h"
#include "engine/fit/fit_model.h"
#include "engine/fit/moment_sums.h"
#include "engine/fit/paper_steps.h"
#include "engine/fit/plane_outline.h"
#include "engine/fit/robust.h"
#include "engine/fit/robust_fits.h"
#include "engine/fit/validate.h"

namespace patchlab {
namespace {

template <class... Numbers>
std::string line(const char* format, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

std::string words(SurfaceType surface) {
  std::string text(name(surface));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

Result<void> check_options(const Workbench& work) {
  const double gamma = work.containment;
  if (!(gamma > 0.0 && gamma <= 1.0)) {
    return Error{ErrorCode::usage, line("Containment must be in (0, 1], not %g.", gamma)};
  }
  if (work.bounds == BoundsMethod::paper && gamma == 1.0) {
    return Error{
        ErrorCode::usage,
        "Containment 1 with the paper's bounds is infinite; choose a containment below 1 or the extent bounds."};
  }
  return {};
}

void log_bound(Workbench& work) {
  const Boundary b = boundary(work.patch);
  StepNote note{Step::bound, name(work.plan.type->boundary), {}, static_cast<int>(b.d.size())};
  std::copy(b.d.begin(), b.d.end(), note.numbers.begin());
  work.log.push_back(note);
}

bool by_paper(const Workbench& work) { return work.options.method == FitMethod::paper; }

const SurfaceFit* plane_of_step_1(const Workbench& work) {
  return work.plan.apex == Apex::by_plane ? &work.plane_fit : nullptr;
}

// The one that was asked for, or the one that the points fill most tightly.
BoundaryType plane_boundary(Workbench& work) {
  switch (work.options.boundary) {
    case BoundaryRequest::ellipse:
      return BoundaryType::ellipse;
    case BoundaryRequest::circle:
      return BoundaryType::circle;
    case BoundaryRequest::rectangle:
      return BoundaryType::rectangle;
    case BoundaryRequest::convex_quad:
      return BoundaryType::convex_quad;
    case BoundaryRequest::automatic:
      break;
  }
  work.outlines = choose_outline(foot_points(work.samples, work.surface));
  return work.outlines.front().boundary;
}

void bound(Workbench& work) {
  work.patch = bounded_patch(work.samples, work.surface, work.moments, work.cov_joint, work.plan,
                             plane_of_step_1(work));
  if (const std::optional<Clamped> clamped = clamp_to_surface(work.patch)) {
    work.notes.push_back(
        {"bound_clamped", clamped->d, clamped->limit,
         line("The points reach %.3g mm from the apex, beyond what this surface has of its radius of "
              "%.3g mm; the outline ends there.",
              1e3 * clamped->d, 1e3 * clamped->limit)});
  }
  log_bound(work);
}

// Eq. (31): the quad of a rectangle.
void bound_quad_by_moments(Workbench& work) {
  const PatchTypeRow* quad = work.plan.type;
  work.plan.type = find_patch_type(SurfaceType::plane, BoundaryType::rectangle);
  bound(work);
  work.patch = quad_of_rectangle(work.patch);
  work.plan.type = quad;
}

void bound_quad_by_edges(Workbench& work) {
  std::optional<Patch> quad = quad_patch(work.samples, work.surface, work.feet, work.containment);
  if (!quad) {
    work.notes.push_back(
        {"no_four_edges", 0.0, 0.0,
         "The points do not have four edges; the convex quad is the rectangle of their extent."});
    return bound_quad_by_moments(work);
  }
  work.patch = std::move(*quad);
  log_bound(work);
}

}  // namespace

Result<Workbench> begin(const Observations& observations, const FitOptions& options) {
  Workbench work;
  work.options = options;
  const bool paper = options.method == FitMethod::paper;
  work.bounds = options.bounds.value_or(paper ? BoundsMethod::paper : BoundsMethod::extent);
  work.containment = options.containment.value_or(work.bounds == BoundsMethod::paper ? 0.95 : 1.0);
  const Result<void> sane = check_options(work);
  if (!sane) return sane.error();
  Result<Samples> samples = make_samples(observations, least_points(options.surface));
  if (!samples) return samples.error();
  work.samples = std::move(*samples);
  if (paper) std::fill(work.samples.bends.begin(), work.samples.bends.end(), std::uint8_t{1});
  if (const std::size_t flat = work.samples.semidefinite; flat > 0) {
    work.notes.push_back(
        {"covariance_semidefinite", static_cast<double>(flat), 0.0,
         line("%zu covariances have no extent in some direction; where a surface lies across it, a "
              "millionth of their size counts there.",
              flat)});
  }
  return work;
}

Result<Workbench> begin_from(const Patch& kept, const Observations& observations, const FitOptions& options) {
  FitOptions named = options;
  named.surface = *surface_request_from_name(name(kept.type->surface));
  named.boundary = *boundary_request_from_name(name(kept.type->boundary));
  Result<Workbench> work = begin(observations, named);
  if (!work) return work;
  SurfaceState state;
  for (int i = 0; i < kept.type->curvature_size; ++i)
    state.k[i] = kept.parameters[kept.type->curvature_at() + i];
  state.R = axes(kept);
  state.c = centre(kept) - work->samples.origin;
  work->kept = state;
  return work;
}

void fit_plane(Workbench& work) {
  if (work.options.robust) work.noise_holds = keep_quadric_inliers(work.samples, work.options.seed);
  if (by_paper(work)) {
    paper_plane(work);
  } else {
    work.plane = initial_plane(work.samples);
  }
  const Vector3d n = work.plane.R.col(2);
  work.log.push_back({Step::plane, {}, {n.x(), n.y(), n.z()}, 3});
}

void fit_surfaces(Workbench& work) {
  if (by_paper(work)) return paper_surfaces(work);
  const std::vector<ModelKind> kinds = candidate_models(work.options.surface, work.samples.size());
  const ModelStart start{quadratic_fit(work.samples, work.plane), work.kept};
  if (!work.options.robust) {
    work.fits = fit_models(work.samples, kinds, start);
  } else {
    RobustFits robust = work.noise_holds ? fit_models_robustly(work.samples, kinds, start)
                                         : fit_models_falling(work.samples, kinds, start);
    work.fits = std::move(robust.fits);
    work.robust_scale = robust.scale;
  }
  for (const SurfaceFit& fit : work.fits) {
    work.log.push_back({Step::surface,
                        name(surface_type(fit)),
                        {fit.chi2, static_cast<double>(fit.iterations), fit.state.k[0], fit.state.k[1]},
                        4});
  }
}

void refine_type(Workbench& work) {
  if (by_paper(work)) return paper_type(work);
  work.choice = choose(work.fits, work.samples.size());
  work.surface = work.fits[work.choice.best];
  SurfaceFitOptions options;
  options.robust = work.options.robust;
  options.robust_scale = work.robust_scale;
  for (int pass = 0; pass < 2 && reevaluate_noise(work.samples, work.surface); ++pass) {
    const int before = work.surface.iterations;
    work.surface =
        fit_surface(work.samples, work.surface.model, work.surface.state, options, work.surface.prior);
    work.surface.iterations += before;
  }
  if (options.robust) flag_outliers(work.samples, work.surface, work.robust_scale);
  work.surface_type = surface_type(work.surface);
  work.log.push_back({Step::type, name(work.surface_type)});
}

void choose_boundary(Workbench& work) {
  const SurfaceType surface = work.surface_type;
  const BoundaryType boundary =
      surface == SurfaceType::plane ? plane_boundary(work) : default_boundary(surface);
  work.plan.type = find_patch_type(surface, boundary);
  work.plan.apex = by_paper(work) ? Apex::by_plane : Apex::over_centroid;
  work.plan.scale =
      work.bounds == BoundsMethod::extent ? extent_scale(work.containment) : paper_scale(work.containment);
  work.log.push_back({Step::boundary, name(boundary), {work.containment}, 1});
}

void project_points(Workbench& work) {
  JointOptions options;
  if (by_paper(work)) {
    options = {Distance::paper, Projection::plain, false,
               work.plane_fit.A.size() > 0 ? &work.plane_fit : nullptr};
  }
  ProjectedSamples projected = project(work.samples, work.surface, options);
  work.feet = std::move(projected.feet);
  work.moments = projected.moments;
  work.cov_joint = JointCovariance(projected.sums, work.surface, options.plane);
  work.log.push_back({Step::projection, {}, {static_cast<double>(work.samples.size())}, 1});
}

void bound_cylinder(Workbench& work) {
  if (work.plan.type->boundary == BoundaryType::rectangle && work.plan.type->curvature_size > 0) bound(work);
}
void bound_revolute(Workbench& work) {
  if (work.plan.type->boundary == BoundaryType::circle && work.plan.type->curvature_size > 0) bound(work);
}
void bound_paraboloid(Workbench& work) {
  if (work.plan.type->boundary == BoundaryType::ellipse && work.plan.type->curvature_size > 0) bound(work);
}
void bound_plane(Workbench& work) {
  if (work.plan.type->surface != SurfaceType::plane) return;
  const bool extent = work.bounds == BoundsMethod::extent;
  if (work.plan.type->boundary != BoundaryType::convex_quad) {
    if (work.plan.type->boundary == BoundaryType::rectangle && extent) {
      work.plan.direction = soft_direction(work.samples, work.surface, work.feet, work.moments);
    }
    bound(work);
  } else if (extent) {
    bound_quad_by_edges(work);
  } else {
    bound_quad_by_moments(work);
  }
}

Result<FitResult> conclude(Workbench& work) {
  if (!work.surface.converged && !by_paper(work)) {
    return Error{
        ErrorCode::no_finite_fit,
        line(
            "The fit of the %s did not converge in %d iterations; select a larger region, or another surface.",
            words(work.surface_type).c_str(), work.surface.iterations)};
  }
  FitResult result;
  result.patch = conventional(work.patch, work.samples.origin + work.samples.mean_viewpoint());
  if (const Result<void> valid = validate(result.patch); !valid) {
    return Error{ErrorCode::no_finite_fit,
                 "The fit ended at what is no patch; select another region, or another surface. " +
                     valid.error().message};
  }
  FitReport& report = result.report;
  report.method = work.options.method;
  report.bounds = work.bounds;
  report.containment = work.containment;
  report.robust = work.options.robust;
  report.candidates = work.choice.candidates;
  report.outlines = work.outlines;
  report.warnings = work.notes;
  report.iterations = work.surface.iterations;
  report.converged = work.surface.converged;
  report.residuals = std::move(work.feet.F);
  for (std::size_t i = 0; i < work.samples.size(); ++i) {
    if (work.samples.robust[i] == 0.0) {
      report.outliers.push_back(static_cast<std::uint32_t>(i));
    } else if (work.samples.bends[i] == 0) {
      ++report.edge_points;
    } else {
      report.chi2 += report.residuals[i] * report.residuals[i];
    }
  }
  report.points = work.samples.size() - report.outliers.size();
  report.dof = static_cast<int>(report.points - report.edge_points) - work.surface.model.effective_parameters;
  validate_fit(work.samples, work.surface, work.feet, result.patch, work.options, report);
  report.steps = std::move(work.log);
  return result;
}

}  // namespace patchlab
