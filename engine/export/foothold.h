// Where a foot may stand on a patch: a convex polygon that keeps away from the outline.
#pragma once

#include <vector>

#include "engine/export/export.h"

namespace patchlab {

// What lies within the outline and at least inset_sigmas standard deviations of it (as `outline_band` gives
// them; none without a covariance) and foot_radius away from it, in the xy plane of the patch, m. Convex,
// counterclockwise, never outside: a round outline counts as the polygon of 128 points on it. Empty where
// nothing is left.
std::vector<Vector2d> inner_polygon(const Patch& patch, double inset_sigmas, double foot_radius);

// How far the surface leaves the tangent plane at the apex within a polygon, m: least and greatest z, 0
// included.
Vector2d height_range(const Patch& patch, const std::vector<Vector2d>& polygon);

double polygon_area(const std::vector<Vector2d>& polygon);  // m^2

}  // namespace patchlab
