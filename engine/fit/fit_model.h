// Step 2 for one candidate model: where its fit starts, the prior of its vertex, robust or not.
#pragma once

#include <optional>

#include "engine/fit/fit_surface.h"

namespace patchlab {

// The 2-jet over the centroid: every candidate resembles it, so the noise is re-evaluated on it before they
// are fitted. Its state is the height field's own where the fit does not end.
SurfaceFit quadratic_fit(Samples& samples, const SurfaceState& plane);

// What the fits of all models start from.
struct ModelStart {
  SurfaceFit two_jet;
  std::optional<SurfaceState> kept;  // the surface that is refitted: the one start, where there is one
};

// The best of the model's starts, a paraboloid's with the prior of its vertex.
SurfaceFit fit_model(const Samples& samples, const SurfaceModel& model, const ModelStart& start);

// Each candidate by itself.
std::vector<SurfaceFit> fit_models(const Samples& samples, const std::vector<ModelKind>& kinds,
                                   const ModelStart& start);

}  // namespace patchlab
