// Step 2: an unbounded surface by weighted Levenberg-Marquardt, Eqs. (33)-(36), with the exact distance or
// the paper's.
#pragma once

#include <optional>
#include <vector>

#include "engine/fit/distance.h"
#include "engine/fit/initial_surface.h"
#include "engine/fit/samples.h"
#include "engine/fit/surface_model.h"

namespace patchlab {

// The vertex of a paraboloid is where its patch is centred, by definition: c ~ N(centre, sigma^2) along each
// tangent direction (method M4; without it eight parameters meet six numbers).
struct VertexPrior {
  Vector3d centre;                       // m, on the surface over the centroid of the points
  Eigen::Matrix<double, 3, 2> tangents;  // unit columns
  double sigma;                          // m
  double size;                           // m, about the patch's radius
};

struct SurfaceFit {
  SurfaceModel model{};
  SurfaceState state;
  StepMatrix A{};     // normal matrix of the free parameters at the solution, prior included
  double chi2 = 0.0;  // of the points, robust weights not applied to it
  double cost = 0.0;  // what was minimised: prior and robust loss included
  int iterations = 0, evaluations = 0;
  bool converged = false;
  std::optional<VertexPrior> prior;
};

// A^-1 in the whole chart: the covariance of the step where residuals are of unit variance; zero where held.
ChartMatrix chart_covariance(const SurfaceFit& fit);

struct SurfaceFitOptions {
  Distance distance = Distance::exact;
  bool robust = false;        // Tukey's loss, 4.685 standard deviations
  double robust_scale = 1.0;  // what counts as a standard deviation there, in those of the noise model
  LeastSquaresOptions solver = {.initial_damping = 1e-4};  // starts are near: height fields, other models
};

// Minimises from a state.
SurfaceFit fit_surface(const Samples& samples, const SurfaceModel& model, const SurfaceState& start,
                       const SurfaceFitOptions& options,
                       const std::optional<VertexPrior>& prior = std::nullopt);
// The best of a model's starts: each is tried for a few iterations, the one of least cost goes on.
SurfaceFit fit_surface(const Samples& samples, const SurfaceModel& model, const Starts& starts,
                       const SurfaceFitOptions& options,
                       const std::optional<VertexPrior>& prior = std::nullopt);

// Tukey's weight of a residual in standard deviations.
double tukey_weight(double F);

// The prior of a model's vertex, and the state to start its free fit from.
struct VertexStart {
  VertexPrior prior;
  SurfaceState state;  // frame turned to the normal at the prior's centre
};
// From a fit of the model with its vertex held over the mean (method M4).
VertexStart vertex_start(const Samples& samples, const SurfaceFit& fixed);

// Covariances of a sensor model re-evaluated at the foot points (method M11). False where they are constants.
bool reevaluate_noise(Samples& samples, const SurfaceFit& fit);

}  // namespace patchlab
