// How far a fit is from the truth, in units of its own covariance (normalised estimation error squared).
#pragma once

#include <string>
#include <vector>

#include "engine/patch/patch.h"

namespace patchlab::test {

struct Nees {
  double value = 0.0;  // infinite where the covariance is singular: it rules the truth out
  int dof = 0;
  Eigen::VectorXd errors;  // per component
  Eigen::VectorXd sigmas;  // predicted standard deviations of the same
};

// The unbounded surface alone, in what its type determines (gauge-invariant): plane 3, sphere 4 (kappa,
// centre), cylinder 5 (kappa, axis), cylindric paraboloid 6, circular paraboloid 6, elliptic and
// hyperbolic 8.
Nees surface_nees(const Patch& fitted, const Patch& truth);
// What its components are: kappa curvature, w or tilt rotation, n normal, t translation, in the fit's axes.
std::vector<std::string> surface_error_names(SurfaceType surface);
// All parameters with the bounds, in the local chart, the truth described by its nearest symmetry.
Nees full_nees(const Patch& fitted, const Patch& truth);
// The description of the truth, among those of its symmetries, whose axes are nearest to the fit's.
Patch nearest_description(const Patch& fitted, const Patch& truth);

}  // namespace patchlab::test
