#include "engine/fit/validate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/base/chi_square.h"
#include "engine/fit/coverage.h"
#include "engine/fit/patch_distance.h"

namespace patchlab {
namespace {

std::string text(const char* format, double a, double b = 0.0) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

double depth_sigma(const Samples& samples, const Patch& patch) {
  const Vector3d z = axes(patch).col(2);
  return std::sqrt(z.dot(samples.mean_cov() * z));
}

// |kappa| d along each axis.
Vector2d bends(const Patch& patch) {
  return k3(patch).head<2>().cwiseAbs().cwiseProduct(extent(boundary(patch)));
}

double sigma_of(const Patch& patch, int index) {
  return std::sqrt(std::max((*patch.covariance_local)(index, index), 0.0));
}

void check_limits(const Patch& patch, const ValidationLimits& limits, FitReport& report) {
  const auto reject = [&](std::string name, double value, double limit, std::string sentence) {
    report.reasons.push_back({std::move(name), value, limit, std::move(sentence)});
  };
  if (!report.converged) {
    reject("convergence", report.iterations, report.iterations,
           "The fit did not converge; its result is the last state.");
  }
  if (report.p_value < limits.p_value) {
    const double ratio = std::sqrt(report.chi2 / report.dof);
    reject(
        "chi_square", report.p_value, limits.p_value,
        text("Residuals are %.2g times larger than the noise model says: another surface, outliers, or noise "
             "underestimated.",
             ratio));
  }
  if (report.residual_rms > limits.residual_rms) {
    reject("residual", report.residual_rms, limits.residual_rms,
           text("The points lie %.2g mm (RMS) off the surface; the limit is %.2g mm.",
                1e3 * report.residual_rms, 1e3 * limits.residual_rms));
  }
  if (report.coverage < limits.coverage) {
    reject("coverage", report.coverage, limits.coverage,
           text("Only %.0f %% of the patch is covered by points as it should be; the limit is %.0f %%.",
                100 * report.coverage, 100 * limits.coverage));
  }
  const double bend = bends(patch).maxCoeff();
  if (bend > limits.curvature_extent) {
    reject(
        "curvature", bend, limits.curvature_extent,
        text(
            "Curvature times extent is %.2g, more than %.2g: the patch bends out of what one surface can hold.",
            bend, limits.curvature_extent));
  }
}

// A type that was named, where the points bend otherwise.
void check_type(const Patch& patch, SurfaceRequest request, FitReport& report) {
  const bool elliptic = patch.type->surface == SurfaceType::elliptic_paraboloid;
  const bool other = (request == SurfaceRequest::elliptic_paraboloid && !elliptic) ||
                     (request == SurfaceRequest::hyperbolic_paraboloid && elliptic);
  if (!other) return;
  const Eigen::Index at = patch.type->curvature_at();
  const Eigen::Index flatter =
      std::abs(patch.parameters[at]) < std::abs(patch.parameters[at + 1]) ? at : at + 1;
  const double kappa = patch.parameters[flatter], sigma = sigma_of(patch, static_cast<int>(flatter));
  report.reasons.push_back(
      {"type", kappa / sigma, 0.0,
       text(
           elliptic
               ? "Hyperbolic was asked for, but the points bend to one side: the curvatures have one sign, the lesser "
                 "is %.2g +- %.2g 1/m."
               : "Elliptic was asked for, but the points bend to both sides: the curvatures differ in sign, the "
                 "lesser is %.2g +- %.2g 1/m.",
           kappa, sigma)});
}

void warn_few_points(const SurfaceFit& fit, FitReport& report) {
  const double enough = 5.0 * fit.model.effective_parameters;
  const auto points = static_cast<double>(report.points);
  if (points >= enough) return;
  report.warnings.push_back(
      {"few_points", points, enough,
       text("Only %.0f points; below %.0f the covariance is a rough guess.", points, enough)});
}

// Those of method M10 that concern the curvature and the axis.
void warn_curvature(const Samples& samples, const Patch& patch, FitReport& report) {
  const PatchTypeRow& type = *patch.type;
  const auto warn = [&](std::string name, double value, double limit, std::string sentence) {
    report.warnings.push_back({std::move(name), value, limit, std::move(sentence)});
  };
  if (type.curvature_size == 0) return;
  const int last = type.curvature_at() + type.curvature_size - 1;
  const double kappa = patch.parameters[last], significance = std::abs(kappa) / sigma_of(patch, last);
  const double sag = 0.5 * bends(patch).cwiseProduct(extent(boundary(patch))).maxCoeff();
  const double noise = depth_sigma(samples, patch);
  if (type.surface == SurfaceType::circular_cylinder || type.surface == SurfaceType::cylindric_paraboloid) {
    const double spin = sigma_of(patch, type.rotation_at() + 2);
    if (significance < 5.0 || spin > 0.3) {
      warn(
          "axis_undetermined", spin, 0.3,
          text(
              "The axis is not determined: its direction is uncertain by %.2g rad and the curvature is %.2g standard "
              "deviations from zero; a plane may say as much.",
              spin, significance));
    }
  } else if (significance < 3.0) {
    warn("curvature_insignificant", significance, 3.0,
         text("The curvature is %.2g standard deviations from zero: a plane may say as much.", significance));
  }
  if (sag < noise) {
    warn(
        "low_signal", sag, noise,
        text(
            "The surface bends by %.2g mm over the patch, less than the noise of one point (%.2g mm): curvature is not "
            "significant at this range.",
            1e3 * sag, 1e3 * noise));
  }
  const bool bounded = type.surface == SurfaceType::sphere || type.surface == SurfaceType::circular_cylinder;
  const Vector3d from = centre(patch) - samples.origin - samples.viewpoint(0);
  const double tilt = std::acos(std::clamp(std::abs(axes(patch).col(2).dot(from.normalized())), 0.0, 1.0));
  const double reach = tilt + std::asin(std::min(bends(patch).maxCoeff(), 1.0));
  constexpr double limit = 80.0 * 3.14159265358979 / 180.0;
  if (bounded && kappa < 0.0 && reach > limit) {
    warn(
        "self_occluded", reach, limit,
        "Part of the surface turns away from the sensor and was never seen: the outline is that of the part observed.");
  }
}

void warn_orientation(const Patch& patch, FitReport& report) {
  const PatchTypeRow& type = *patch.type;
  if (type.revolute()) return;
  if (type.surface != SurfaceType::plane) return;
  const double spin = sigma_of(patch, type.rotation_at() + 2);
  const double aspect = patch.parameters[0] / patch.parameters[1];
  const bool round = type.boundary == BoundaryType::ellipse && aspect < 1.05;
  if (spin > 0.3 || round) {
    report.warnings.push_back(
        {"orientation_undetermined", round ? aspect : spin, round ? 1.05 : 0.3,
         text("The outline is nearly as wide as long: its direction in the plane is uncertain by "
              "%.2g rad.",
              spin)});
  }
}

void warn_singular(const Patch& patch, FitReport& report) {
  if (!near_singular(patch)) return;
  report.warnings.push_back(
      {"near_singular", 0.0, 0.0,
       "The normal points nearly against z of this frame, where r_xy is singular: read the local "
       "covariance, or use a frame whose z does not oppose the normals."});
}

void warn_outliers(const FitOptions& options, const Patch& patch, FitReport& report) {
  if (!options.robust || report.outliers.empty()) return;
  const double share = static_cast<double>(report.outliers.size()) /
                       static_cast<double>(report.outliers.size() + report.points);
  if (share > 0.02 && patch.type->curvature_size > 0) {
    report.warnings.push_back(
        {"outliers", share, 0.02,
         text(
             "%.0f %% of the points were flagged as outliers; on a curved surface near ones cannot be told apart, so the "
             "covariance is optimistic.",
             100 * share)});
  }
}

bool overstates_noise(const FitReport& report) {
  return report.chi2 / report.dof < 1.0 - 5.0 * std::sqrt(2.0 / report.dof);
}

void warn_overstated_noise(FitReport& report) {
  if (!overstates_noise(report)) return;
  const double ratio = report.chi2 / report.dof;
  report.warnings.push_back(
      {"noise_overstated", ratio, 1.0 - 5.0 * std::sqrt(2.0 / report.dof),
       text("Residuals are only %.2g of what the noise model says.", std::sqrt(ratio))});
}

std::string verdict(const FitReport& report) {
  if (!report.reasons.empty()) return "Not accepted: " + report.reasons.front().sentence;
  if (overstates_noise(report)) return "Accepted, with standard deviations that are larger than need be.";
  return "Agrees with the noise model.";
}

// On the xy plane of the patch.
std::vector<Vector2d> feet_on(const Patch& patch, const Samples& samples, const SurfaceFit& fit,
                              const FootPoints& feet) {
  const Matrix3d patch_from_world = axes(patch).transpose();
  const Eigen::Matrix<double, 2, 3> turn = (patch_from_world * fit.state.R).topRows<2>();
  const Vector2d shift = (patch_from_world * (samples.origin + fit.state.c - centre(patch))).head<2>();
  std::vector<Vector2d> on_patch(feet.x.size());
  for (std::size_t i = 0; i < on_patch.size(); ++i) on_patch[i] = shift + turn * feet.x[i];
  return on_patch;
}

}  // namespace

void validate_fit(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet, const Patch& patch,
                  const FitOptions& options, FitReport& report) {
  report.p_value = report.dof > 0 ? chi_square_p_value(report.chi2, report.dof) : 1.0;
  report.residual_rms = distance_rms(patch, samples);
  report.coverage = coverage(patch, feet_on(patch, samples, fit, feet), feet.weight);
  check_type(patch, options.surface, report);
  check_limits(patch, options.limits, report);
  warn_overstated_noise(report);
  warn_few_points(fit, report);
  warn_curvature(samples, patch, report);
  warn_orientation(patch, report);
  warn_singular(patch, report);
  warn_outliers(options, patch, report);
  report.accepted = report.reasons.empty();
  report.verdict = verdict(report);
}

}  // namespace patchlab
