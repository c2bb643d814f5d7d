// A start that a sloppy lasso does not spoil, and the flagging of outliers (method M12).
#pragma once

#include <cstdint>

#include "engine/fit/fit_surface.h"

namespace patchlab {

// RANSAC of a quadric (9 points, 80 draws, truncated cost) over the plane of step 1; the robust weights
// become 1 for its inliers and 0 for the rest. False where fewer than half are inliers: the noise model says
// too little, or no quadric holds these points; the weights then are 1 for the half of the points that lies
// nearest to the draw of least median. Seeded: the same points and seed give the same weights.
bool keep_quadric_inliers(Samples& samples, std::uint64_t seed);

// How large residuals are in units of the noise model, by the median of those that have a robust weight.
double residual_scale(const Samples& samples, const SurfaceFit& fit);

// The same as flagging takes it where half of the points are inliers: 1 where the model holds, less where it
// says too much noise (then outliers would hide in it). In [0.2, 1]; values above 0.8 count as 1.
double robust_scale(const Samples& samples, const SurfaceFit& fit);

// Robust weights after a fit with Tukey's loss: 0 for points beyond 3.5 times `scale` standard deviations
// (flagged, never counted for bounds), Tukey's own for the rest.
void flag_outliers(Samples& samples, const SurfaceFit& fit, double scale);

inline constexpr double flag_limit = 3.5;  // standard deviations

}  // namespace patchlab
