// How the points of a fit lie on the bounded patch: whether they cover it, and how far they are off it.
#pragma once

#include <vector>

#include "engine/patch/patch.h"

namespace patchlab {

// Share of the patch's cells that hold their share of points (research thresholds of the patch library's
// authors): square cells on the xy plane of the patch; a cell is good when its points inside the bound are at
// least half of what its inside area leads to expect, and those outside at most half of what its outside area
// would; a point is outside where it is beyond the outline by two standard deviations of it. Twelve points a
// cell, 50 cells at most. In [0, 1].
double coverage(const Patch& patch, const std::vector<Vector3d>& feet_patch,
                const std::vector<double>& weights);

// Root of the mean squared distance of the points to the bounded patch, m: to their foot on the surface, or
// to the outline where that foot is beyond it. Points of weight 0 do not count.
double distance_rms(const Patch& patch, const std::vector<Vector3d>& points_patch,
                    const std::vector<double>& weights);

}  // namespace patchlab
