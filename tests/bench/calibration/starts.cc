#include "tests/bench/calibration/starts.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/fit/fit_surface.h"
#include "tests/support/parallel.h"

namespace patchlab::calibration {
namespace {

using namespace test;

constexpr double largest_axis_error = 20.0;  // degrees; the false minimum lies at 90

// The plane of step 1 with its x axis turned from the true axis by `angle`, in radians.
SurfaceState turned_plane(const Samples& samples, const Patch& truth, double angle) {
  SurfaceState plane = initial_plane(samples);
  const Vector3d z = plane.R.col(2), axis = axes(truth).col(0);
  const Vector3d along = (axis - z * z.dot(axis)).normalized();
  plane.R.col(0) = std::cos(angle) * along + std::sin(angle) * z.cross(along);
  plane.R.col(1) = z.cross(plane.R.col(0));
  return plane;
}

SurfaceFit calibrated_fit(const Samples& samples, const SurfaceState& plane) {
  const SurfaceModel& cylinder = surface_model(ModelKind::circular_cylinder);
  return fit_surface(samples, cylinder, starts(samples, cylinder, height_field(samples, plane)), {});
}

// kappa = 0 in the plane of step 1, as printed.
SurfaceFit paper_fit(const Samples& samples, const SurfaceState& plane) {
  SurfaceFitOptions options;
  options.distance = Distance::paper;
  options.solver.max_iterations = 500;
  return fit_surface(samples, surface_model(ModelKind::circular_cylinder), plane, options);
}

bool found(const SurfaceFit& fit, const Patch& truth) {
  const double cosine = std::abs(fit.state.R.col(0).dot(axes(truth).col(0)));
  const bool right_sign = fit.state.k[0] * curvatures(truth)[0] > 0.0;
  return fit.converged && right_sign && cosine > std::cos(largest_axis_error * std::numbers::pi / 180.0);
}

struct Outcome {
  bool calibrated = false, paper = false;
};

Outcome run_trial(const BatteryOptions& options, double angle, int number) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::circular_cylinder, BoundaryType::rectangle);
  Random random(trial_seed(options.seed, type, number));
  const Scenario scenario = random_scenario(random, type, number % 2 == 0, options.scenario);
  const Observations observations = observe(random, scenario, options.scenario);
  const Result<Samples> samples = make_samples(observations, 6);
  if (!samples) return {};
  const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
  const SurfaceState plane = turned_plane(*samples, scenario.truth, side * angle);
  return {found(calibrated_fit(*samples, plane), scenario.truth),
          found(paper_fit(*samples, plane), scenario.truth)};
}

StartCell run_cell(const BatteryOptions& options, double degrees) {
  std::vector<Outcome> outcomes(static_cast<std::size_t>(options.trials));
  for_each_index(options.trials, options.threads, [&](int i) {
    outcomes[static_cast<std::size_t>(i)] = run_trial(options, degrees * std::numbers::pi / 180.0, i);
  });
  StartCell cell{degrees, options.trials};
  for (const Outcome& outcome : outcomes) {
    cell.calibrated += outcome.calibrated ? 1 : 0;
    cell.paper += outcome.paper ? 1 : 0;
  }
  return cell;
}

}  // namespace

std::vector<StartCell> cylinder_starts(const BatteryOptions& options) {
  std::vector<StartCell> cells;
  for (int degrees = 0; degrees <= 90; degrees += 10) cells.push_back(run_cell(options, degrees));
  return cells;
}

}  // namespace patchlab::calibration
