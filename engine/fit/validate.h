// What a fit is worth: residual, chi-square, coverage, curvature, rank; each a named finding with its value
// and limit.
#pragma once

#include "engine/fit/fit_patch.h"
#include "engine/fit/foot_points.h"

namespace patchlab {

// Fills in chi-square's p-value, residual_rms, coverage, reasons, warnings, accepted and verdict. `feet` are
// of the surface fit; the rest of the report must be there already.
void validate_fit(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet, const Patch& patch,
                  const FitOptions& options, FitReport& report);

}  // namespace patchlab
