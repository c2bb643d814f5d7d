// Step 9 where moments do not serve: the convex quad, and the direction of a nearly square rectangle.
#pragma once

#include <optional>

#include "engine/fit/fit_boundary.h"
#include "engine/fit/soft_edge.h"

namespace patchlab {

// The convex quad about a plane's foot points, each half-diagonal times sqrt(Gamma), with the covariance of
// all eleven parameters: the edges' own by their likelihood, the plane's by its fit. Nothing where the points
// do not have four edges.
std::optional<Patch> quad_patch(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet,
                                double containment);

// Eq. (31): a plane's rectangle as a convex quad, d = |(d_x, d_y)| four times, gamma = atan2(d_y, d_x).
Patch quad_of_rectangle(const Patch& rectangle);

// The direction of a rectangle's longer side in the frame of the fit, where its principal variances are so
// alike (axes within a ratio of 1.2) that the angle of the moments (32) says nothing; absent otherwise.
std::optional<PlaneDirection> soft_direction(const Samples& samples, const SurfaceFit& fit,
                                             const FootPoints& feet, const MomentVector& moments);

}  // namespace patchlab
