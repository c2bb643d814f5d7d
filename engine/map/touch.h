// Exproprioception: a foot put down re-measures a patch through kinematics and touch. The same Kalman update
// as that of a second scan; the contact stands in the patch's frame, with a covariance that the chain of
// joints gave it (independent of the patch).
#pragma once

#include "engine/base/result.h"
#include "engine/patch/patch.h"

namespace patchlab {

struct Touched {
  Patch patch;        // updated
  double chi2 = 0.0;  // of the contact against the patch before
  int dof = 0;
  double p_value = 0.0;
};

// A point of contact, m, with its covariance: it lies on the surface. usage error where no sheet of the
// surface lies along its normal there.
Result<Touched> touched_at(const Patch& patch, const Vector3d& point, const Matrix3d& cov_point);
// A plane in contact (a sole, say: a plane patch with covariance, its normal either way): at the plane's
// centre the surface has its height and slope. usage error as above, or where `contact` is no plane.
Result<Touched> touched_by(const Patch& patch, const Patch& contact);

}  // namespace patchlab
