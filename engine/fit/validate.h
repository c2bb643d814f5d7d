// What a fit is worth: residual, chi-square, coverage, curvature, rank; each a named finding with its value
// and limit.
#pragma once

#include "engine/fit/fit_patch.h"
#include "engine/fit/fit_surface.h"

namespace patchlab {

// Share of the patch's cells that hold their share of points (research thresholds of the patch library's
// authors): square cells on the xy plane of the patch; a cell is good when its points inside the bound are at
// least half of what its inside area leads to expect, and those outside at most half of what its outside area
// would; a point is outside where it is beyond the outline by two standard deviations of it. Twelve points a
// cell, 50 cells at most. In [0, 1].
double coverage(const Patch& patch, const std::vector<Vector3d>& points_patch,
                const std::vector<double>& weights);

// Fills in chi-square's p-value, residual_rms, coverage, reasons, warnings, accepted and verdict. `feet` are
// of the surface fit; the rest of the report must be there already.
void validate_fit(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet, const Patch& patch,
                  const FitOptions& options, FitReport& report);

}  // namespace patchlab
