// Step 3 by evidence: which surface the points ask for, by BIC over refitted models (method M5).
#pragma once

#include <vector>

#include "engine/fit/fit_patch.h"
#include "engine/fit/fit_surface.h"

namespace patchlab {

// The models a request allows, in the order of their freedom. `points` leaves out those it cannot determine.
std::vector<ModelKind> candidate_models(SurfaceRequest request, std::size_t points);
// Fewest points that determine a request's least surface: p_eff + 1.
std::size_t least_points(SurfaceRequest request);

// chi2 + p_eff ln N.
double bic(const SurfaceFit& fit, std::size_t points);

// The type of Table I that a fit is: elliptic or hyperbolic by the signs of its curvatures.
SurfaceType surface_type(const SurfaceFit& fit);

struct Choice {
  std::size_t best = 0;               // index into the fits
  std::vector<Candidate> candidates;  // best first, with reasons in words
};
// The least BIC. Precondition: at least one fit.
Choice choose(const std::vector<SurfaceFit>& fits, std::size_t points);

}  // namespace patchlab
