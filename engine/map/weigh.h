// How much a further sight of a surface counts beside those before it.
//
// The covariance of a fit is taken at its own estimate and errs with it: a sphere that came out too curved is
// too sure of its curvature. Weights from it pull the fusion aside, twenty fused spheres by a third of their
// standard deviation. So sights that may differ by that alone count alike: the gain takes R for what the mean
// sight before had, P times their number, in every direction where the two are within a factor of two of each
// other, and elsewhere brings R nearer by that factor. It costs an eighth of the variance at most, and the
// covariance of the result is that of the gain taken.
#pragma once

#include "engine/map/joint_update.h"

namespace patchlab {

// For Measurement::R_gain. `sights`: how many the patch that is updated has had, at least 1.
Eigen::MatrixXd levelled(const Measurement& measurement, int sights);

}  // namespace patchlab
