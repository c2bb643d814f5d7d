// Section IV: fit a bounded patch to points with covariances, and the covariance of the result.
//
// Two methods. `calibrated` (default) is the method of engine/README.md, whose covariance is proven by
// Monte Carlo; `paper` is the nine steps of the paper as printed, with the errata that make them computable.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/fit/observation.h"
#include "engine/fit/step_notes.h"
#include "engine/patch/patch.h"

namespace patchlab {

// What surface to fit. `paraboloid` chooses among the five paraboloids (plane included), the paper's step 3;
// `automatic` among all seven. A type named so is forced.
enum class SurfaceRequest {
  automatic,
  paraboloid,
  elliptic_paraboloid,
  hyperbolic_paraboloid,
  cylindric_paraboloid,
  circular_paraboloid,
  plane,
  sphere,
  circular_cylinder,
};
enum class BoundaryRequest { automatic, ellipse, circle, rectangle, convex_quad };  // matters for planes only
enum class FitMethod { calibrated, paper };
enum class BoundsMethod { extent, paper };

std::string_view name(SurfaceRequest request);  // "auto", "paraboloid", "sphere" ...: as on the command line
std::string_view name(BoundaryRequest request);
std::string_view name(FitMethod method);
std::string_view name(BoundsMethod method);
std::optional<SurfaceRequest> surface_request_from_name(std::string_view name);
std::optional<BoundaryRequest> boundary_request_from_name(std::string_view name);
std::optional<FitMethod> fit_method_from_name(std::string_view name);
std::optional<BoundsMethod> bounds_method_from_name(std::string_view name);

// Limits of the validation; the last three are those of the authors' own patch finder, for patches of 5 cm.
struct ValidationLimits {
  double p_value = 1e-3;          // chi-square below it: the noise model or the type is wrong
  double residual_rms = 0.01;     // m
  double coverage = 0.75;         // share of the patch's cells that hold their share of points
  double curvature_extent = 1.5;  // |kappa| times the patch radius
};

struct FitOptions {
  SurfaceRequest surface = SurfaceRequest::automatic;
  BoundaryRequest boundary = BoundaryRequest::automatic;
  FitMethod method = FitMethod::calibrated;
  std::optional<BoundsMethod> bounds;  // absent: follows the method
  std::optional<double> containment;   // Gamma in (0, 1]; absent: 1 for extent, 0.95 for paper
  bool robust = false;                 // RANSAC quadric and Tukey weights
  std::uint64_t seed = 1;              // of the robust fit's draws
  ValidationLimits limits;
};

// A named finding with its value and limit, and the sentence for the user.
struct Finding {
  std::string name;  // chi_square, residual, coverage, curvature, axis_undetermined, ...
  double value = 0.0;
  double limit = 0.0;
  std::string sentence;
};

// One row of the automatic choice: a surface that was fitted, and how well.
struct Candidate {
  SurfaceType surface;
  double chi2 = 0.0;
  int dof = 0;
  double bic = 0.0;  // chi2 + p_eff ln N; the least is chosen
  bool chosen = false;
  std::string reason;  // empty or a sentence
};

// One row of the choice of a plane's outline: the least shape of a kind about the points.
struct OutlineCandidate {
  BoundaryType boundary;
  double area = 0.0;   // m^2
  double score = 0.0;  // 2 N ln(area / m^2) + 2 p ln N; the least is chosen (engine/fit/choose_outline.h)
  bool chosen = false;
};

struct FitReport {
  FitMethod method = FitMethod::calibrated;
  BoundsMethod bounds = BoundsMethod::extent;
  double containment = 1.0;
  bool robust = false;
  std::size_t points = 0;               // observations used, outliers not counted
  std::size_t edge_points = 0;          // of these, at depth edges: in the outline, not in the surface
  std::vector<std::uint32_t> outliers;  // indices of flagged observations, ascending
  double chi2 = 0.0;
  int dof = 0;
  double p_value = 0.0;
  int iterations = 0;
  bool converged = false;
  double residual_rms = 0.0;  // m, of the points' distance to the bounded patch
  double coverage = 0.0;      // in [0, 1]
  bool accepted = false;
  std::vector<Finding> reasons;            // why it was not accepted
  std::vector<Finding> warnings;           // what the user should know of an accepted one
  std::string verdict;                     // one sentence
  std::vector<Candidate> candidates;       // best first
  std::vector<OutlineCandidate> outlines;  // best first; of a plane whose outline was not named
  std::vector<double> residuals;           // per observation, signed, in standard deviations
  std::vector<StepNote> steps;             // with their numbers; steps_in_words() for --explain
};

struct FitResult {
  Patch patch;  // covariance and covariance_local present
  FitReport report;
};

// The fit. Errors: usage (an impossible request), no_finite_fit (too few, coincident or collinear points, a
// covariance that is not positive semi-definite, with its row), cancelled.
Result<FitResult> fit_patch(const Observations& observations, const FitOptions& options,
                            const Progress& progress = {});

// The fit of a kept patch to points added or removed, from where it stands: its surface type and its outline
// are held, no other is tried, and the solver starts at its surface. Same result as a fit that names them, to
// a small part of a standard deviation, in a fraction of its cost. Errors as above.
Result<FitResult> refit_patch(const Patch& kept, const Observations& observations, const FitOptions& options,
                              const Progress& progress = {});

}  // namespace patchlab
