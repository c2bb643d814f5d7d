// Whether the points of a fit cover its bounded patch.
#pragma once

#include <vector>

#include "engine/patch/patch.h"

namespace patchlab {

// Share of the patch's cells that hold their share of points (research thresholds of the patch library's
// authors): square cells on the xy plane of the patch; a cell is good when its points inside the bound are at
// least half of what its inside area leads to expect, and those outside at most half of what its outside area
// would; a point is outside where it is beyond the outline by two standard deviations of it. Twelve points a
// cell, 50 cells at most. In [0, 1].
double coverage(const Patch& patch, const std::vector<Vector2d>& feet_patch,
                const std::vector<double>& weights);

}  // namespace patchlab
