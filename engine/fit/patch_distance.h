// How far the points of a fit lie off its bounded patch.
#pragma once

#include "engine/fit/samples.h"
#include "engine/patch/patch.h"

namespace patchlab {

// Root of the mean squared distance of the points to the bounded patch, m: to their foot on the surface, or
// to the outline where that foot is beyond it. Points of robust weight 0 do not count.
double distance_rms(const Patch& patch, const Samples& samples);

}  // namespace patchlab
