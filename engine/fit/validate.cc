#include "engine/fit/validate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "engine/base/chi_square.h"
#include "engine/patch/surface.h"

namespace patchlab {
namespace {

std::string text(const char* format, double a, double b = 0.0) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

// Cells about the patch: what area of each is inside the bound, and the points it holds.
class CellGrid {
 public:
  CellGrid(const Boundary& bound, const Boundary& doubtless, double side, const Vector2d& reach)
      : bound_(bound),
        doubtless_(doubtless),
        side_(side),
        columns_(count(reach.x())),
        rows_(count(reach.y())) {
    inside_.resize(static_cast<std::size_t>(columns_ * rows_));
    outside_ = inside_;
  }
  void add(const Vector2d& u, double points) {
    const int column = cell(u.x(), columns_), row = cell(u.y(), rows_);
    if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return;
    auto& counts = contains(doubtless_, u) ? inside_ : outside_;
    counts[static_cast<std::size_t>(row * columns_ + column)] += points;
  }
  double score(double expected_per_cell) const {
    int good = 0, counted = 0;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const auto at = static_cast<std::size_t>(row * columns_ + column);
        const double share = share_inside(column, row);
        if (share == 0.0 && outside_[at] == 0.0) continue;
        ++counted;
        const bool filled = inside_[at] >= std::round(0.5 * share * expected_per_cell);
        const bool kept = outside_[at] <= std::round(0.5 * (1.0 - share) * expected_per_cell);
        if (filled && kept) ++good;
      }
    }
    return counted == 0 ? 0.0 : static_cast<double>(good) / counted;
  }

 private:
  int count(double reach) const { return 2 * static_cast<int>(std::ceil(reach / side_)); }
  int cell(double u, int cells) const { return static_cast<int>(std::floor(u / side_)) + cells / 2; }
  double share_inside(int column, int row) const {
    constexpr int fine = 6;
    int hits = 0;
    for (int i = 0; i < fine * fine; ++i) {
      const double x = column - columns_ / 2 + (i % fine + 0.5) / fine,
                   y = row - rows_ / 2 + (i / fine + 0.5) / fine;
      hits += contains(bound_, Vector2d(side_ * x, side_ * y)) ? 1 : 0;
    }
    return hits / static_cast<double>(fine * fine);
  }

  Boundary bound_, doubtless_;  // outside the latter is outside beyond the outline's own doubt
  double side_;
  int columns_, rows_;
  std::vector<double> inside_, outside_;
};

// The outline with every length longer by two of its standard deviations.
Boundary beyond_doubt(const Patch& patch) {
  Boundary grown = boundary(patch);
  if (!patch.covariance_local) return grown;
  const Eigen::Index lengths = grown.type == BoundaryType::convex_quad ? 4 : grown.d.size();
  for (Eigen::Index i = 0; i < lengths; ++i) {
    grown.d[i] += 2.0 * std::sqrt(std::max((*patch.covariance_local)(i, i), 0.0));
  }
  return grown;
}

double orthogonal_rms(const Samples& samples, const SurfaceFit& fit) {
  const Vector3d kappa = k3(fit.model, fit.state.k);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples.robust[i] == 0.0) continue;
    const Vector3d q = to_local(fit.state, samples.q[i]);
    sum += (q - foot_point(q, Matrix3d::Identity(), kappa).x).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

double depth_sigma(const Samples& samples, const Patch& patch) {
  const Vector3d z = axes(patch).col(2);
  double sum = 0.0;
  for (const Matrix3d& cov : samples.cov) sum += z.dot(cov * z);
  return std::sqrt(sum / static_cast<double>(samples.size()));
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

std::string verdict(const FitReport& report) {
  if (!report.reasons.empty()) return "Not accepted: " + report.reasons.front().sentence;
  const double ratio = report.chi2 / report.dof;
  if (ratio < 1.0 - 5.0 * std::sqrt(2.0 / report.dof)) {
    return text(
        "Residuals are only %.2g of what the noise model says: accepted, with sigmas that are larger than need be.",
        std::sqrt(ratio));
  }
  return "Agrees with the noise model.";
}

}  // namespace

double coverage(const Patch& patch, const std::vector<Vector3d>& points_patch,
                const std::vector<double>& weights) {
  constexpr double points_per_cell = 12.0, most_cells = 50.0;
  const Boundary bound = boundary(patch);
  const auto used =
      static_cast<double>(std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0.0; }));
  const double cells = std::clamp(used / points_per_cell, 4.0, most_cells);
  const double side = std::sqrt(area(bound) / cells);
  Vector2d reach = extent(bound);
  for (std::size_t i = 0; i < points_patch.size(); ++i) {
    if (weights[i] > 0.0) reach = reach.cwiseMax(points_patch[i].head<2>().cwiseAbs());
  }
  reach = reach.cwiseMin(3.0 * extent(bound));
  CellGrid grid(bound, beyond_doubt(patch), side, reach);
  for (std::size_t i = 0; i < points_patch.size(); ++i) {
    if (weights[i] > 0.0) grid.add(points_patch[i].head<2>(), used * weights[i]);
  }
  return grid.score(used / cells);
}

void validate_fit(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet, const Patch& patch,
                  const FitOptions& options, FitReport& report) {
  report.p_value = report.dof > 0 ? chi_square_p_value(report.chi2, report.dof) : 1.0;
  report.residual_rms = orthogonal_rms(samples, fit);
  std::vector<Vector3d> points;
  points.reserve(feet.x.size());
  const Pose pose = world_from_patch(patch);
  for (const Vector3d& x : feet.x) {
    points.push_back(apply_inverse(pose, samples.origin + fit.state.c + fit.state.R * x));
  }
  report.coverage = coverage(patch, points, feet.weight);
  check_type(patch, options.surface, report);
  check_limits(patch, options.limits, report);
  warn_few_points(fit, report);
  warn_curvature(samples, patch, report);
  warn_orientation(patch, report);
  warn_singular(patch, report);
  warn_outliers(options, patch, report);
  report.accepted = report.reasons.empty();
  report.verdict = verdict(report);
}

}  // namespace patchlab
