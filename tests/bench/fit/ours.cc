#include "engine/fit/initial_surface.h"
#include "tests/bench/fit/solvers.h"

namespace patchlab::bench {

SurfaceState quadratic_start(const Samples& samples) { return height_field(samples, initial_plane(samples)); }

Solved ours(const Samples& samples, const Objective& objective, double relative_stop) {
  SurfaceFitOptions options;
  options.distance = objective.distance;
  options.solver.max_iterations = most_iterations;
  options.solver.stop = relative_stop * static_cast<double>(samples.size());
  const SurfaceFit fit = fit_surface(samples, surface_model(ModelKind::paraboloid), quadratic_start(samples),
                                     options, objective.prior);
  return {fit.cost, chart_covariance(fit), fit.state.c, fit.evaluations};
}

Points points_of(const Samples& samples) {
  Points points;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    points.q.push_back(samples.q(i));
    points.cov.push_back(samples.cov(i));
  }
  return points;
}

}  // namespace patchlab::bench
