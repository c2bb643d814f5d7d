// The patches that are fitted: a Kinect looks at paraboloids a metre away.
#pragma once

#include "engine/fit/observation.h"
#include "engine/fit/samples.h"

namespace patchlab::bench {

// Elliptic paraboloids of curvatures -8 and -3 1/m, 10 cm in radius, in random poses; noise drawn from each
// point's own covariance (f 525, baseline 7.5 cm, pointing 0.35, disparity 0.17).
std::vector<Observations> patches(std::size_t points, int draws);

// 72 paraboloids of eight pairs of curvatures, among them nearly flat ones, nearly cylinders and saddles, 6,
// 8 and 10 cm in radius: where the vertex is hardly seen, fits crawl.
std::vector<Observations> mixed_patches(std::size_t points);

std::vector<Samples> samples_of(const std::vector<Observations>& all);

}  // namespace patchlab::bench
