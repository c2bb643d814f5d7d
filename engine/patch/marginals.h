// What the covariance of a patch says about things one can see: the centre, the normal, the outline, the
// height. Each is read from covariance_local, to first order. Precondition: it is present.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/patch/patch.h"

namespace patchlab {

// Covariance of the centre c in the world frame, m^2.
Matrix3d cov_centre(const Patch& patch);

// An ellipsoid that holds `probability`: axes are unit columns sorted by length (longest first),
// right-handed, with signs fixed (largest component positive) so that they do not flicker; half_lengths in
// metre, zero for a flat one.
struct Ellipsoid {
  Vector3d centre;
  Matrix3d axes;
  Vector3d half_lengths;
};
Ellipsoid ellipsoid(const Vector3d& centre, const Matrix3d& covariance, double probability);
Ellipsoid centre_ellipsoid(const Patch& patch, double probability);

// The cone that the normal z_l stays in with `probability`: half angles about two body axes (radian), longest
// first; axis columns are directions in the world, perpendicular to z_l.
struct NormalCone {
  Vector3d apex;
  Vector3d normal;
  Eigen::Matrix<double, 3, 2> axes;
  Vector2d half_angles;
};
NormalCone normal_cone(const Patch& patch, double probability);

// Standard deviation of the surface at u along its normal there, m: from kappa and pose.
double height_sigma(const Patch& patch, const Vector2d& u);

// A point of the outline with the standard deviation of its place in the tangent plane, across the curve, m.
struct BandPoint {
  Vector2d u;
  Vector2d outward;  // unit, in the xy plane
  double sigma;
};
std::vector<BandPoint> outline_band(const Patch& patch, int count);

// Per parameter, in order: standard deviation, and correlation (zero where a variance is zero).
PatchVector sigmas(const PatchMatrix& covariance);
PatchMatrix correlation(const PatchMatrix& covariance);

}  // namespace patchlab
