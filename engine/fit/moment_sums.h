// Step 5 in one pass over the samples: foot points, their moments, and the sums of their joint covariance.
#pragma once

#include "engine/fit/moments.h"

namespace patchlab {

struct ProjectedSamples {
  FootPoints feet;
  MomentVector moments;
  JointSums sums;
};

// By the fastest kernels of this machine where they know how: foot points with sampling, and plain
// projections without; one sample at a time otherwise. They leave out moments with z, and sums with them, of
// surfaces with k3.z = 0, whose bounds do not ask for them.
ProjectedSamples project(const Samples& samples, const SurfaceFit& fit, const JointOptions& options,
                         const MomentKernel& kernel = fastest_moment_rows());

// Samples as their fit was given them: Eq. (16) with equal weights, step 5 as printed.
FootPoints plain_projection(const Samples& samples, const SurfaceFit& fit);

}  // namespace patchlab
