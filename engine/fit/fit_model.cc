#include "engine/fit/fit_model.h"

#include <algorithm>
#include <cmath>

#include "engine/fit/initial_surface.h"

namespace patchlab {
namespace {

// A refit starts at the kept surface. A paraboloid's does so at the 2-jet over the new centroid, to which its
// vertex is tied, with the kept axes.
Starts first_states(const Samples& samples, const SurfaceModel& model, const ModelStart& start) {
  if (start.kept && !model.vertex_prior) return {*start.kept};
  const Starts all = starts(samples, model, start.two_jet.state);
  if (!start.kept) return all;
  const Vector3d x = start.kept->R.col(0);
  const auto along = [&](const SurfaceState& state) { return std::abs(x.dot(state.R.col(0))); };
  return {*std::max_element(all.begin(), all.end(),
                            [&](const auto& a, const auto& b) { return along(a) < along(b); })};
}

}  // namespace

SurfaceFit quadratic_fit(Samples& samples, const SurfaceState& plane) {
  const SurfaceModel two_jet = fixed_centre(surface_model(ModelKind::paraboloid));
  const SurfaceState start = height_field(samples, plane);
  SurfaceFit fit = fit_surface(samples, two_jet, start, {});
  for (int pass = 0; pass < 2 && reevaluate_noise(samples, fit); ++pass) {
    fit = fit_surface(samples, two_jet, fit.state, {});
  }
  if (!std::isfinite(fit.cost)) fit.state = start;
  return fit;
}

SurfaceFit fit_model(const Samples& samples, const SurfaceModel& model, const ModelStart& start) {
  const Starts first = first_states(samples, model, start);
  if (!model.vertex_prior) return fit_surface(samples, model, first, {});
  const SurfaceFit fixed = fit_surface(samples, fixed_centre(model), first, {});
  const VertexStart vertex = vertex_start(samples, fixed);
  SurfaceFit fit = fit_surface(samples, model, vertex.state, {}, vertex.prior);
  fit.iterations += fixed.iterations;
  return fit;
}

std::vector<SurfaceFit> fit_models(const Samples& samples, const std::vector<ModelKind>& kinds,
                                   const ModelStart& start) {
  std::vector<SurfaceFit> fits;
  for (const ModelKind kind : kinds) fits.push_back(fit_model(samples, surface_model(kind), start));
  return fits;
}

}  // namespace patchlab
