// Steps 5 to 9: where the bounded patch lies on its surface, how large it is, and what becomes of the
// covariance.
//
// All of it is one function of the surface and of the moments of its foot points (engine/fit/place.h),
// differentiated automatically; the covariance follows by the chain rule (method M8).
#pragma once

#include <optional>

#include "engine/fit/moments.h"
#include "engine/patch/patch.h"

namespace patchlab {

// How moments become lengths: the half-axis is factor * sqrt(variance) in each case.
struct BoundaryScale {
  double ellipse;    // per axis, curved surfaces about c
  double circle;     // of the mean variance per axis, or of the larger where `larger_axis`
  double rectangle;  // per axis, cylinders
  double plane_ellipse, plane_circle, plane_rectangle;  // of the principal variances of planes, step 9
  bool larger_axis = false;                             // steps 7 and 9 as printed: max of the two
};
// Uniform moments times sqrt(Gamma): exactly the fraction Gamma of a uniformly covered patch inside.
BoundaryScale extent_scale(double containment);
// lambda of step 4 and -ln(1 - Gamma) of Eq. (30). Precondition: containment < 1.
BoundaryScale paper_scale(double containment);

// Where z_l of a sphere or circular cylinder comes from.
enum class Apex {
  over_centroid,  // it passes through the centroid (method M6)
  by_plane,       // the normal of step 1's plane, as printed
};

// A direction in the plane known from elsewhere than the moments.
struct PlaneDirection {
  double angle;     // rad, of the patch's x axis in the frame of the fit
  double variance;  // rad^2
};

// What kind of patch to make, and how.
struct PatchPlan {
  const PatchTypeRow* type = nullptr;
  BoundaryScale scale{};
  Apex apex = Apex::over_centroid;
  std::optional<PlaneDirection> direction;
  // Curvatures of the patch from those of the chart: rows of the identity, or step 3's selection and average.
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, 2, 2> curvatures = Matrix2d::Identity();
};

// The bounded patch of a surface fit, in the frame of the points (the fit is about samples.origin),
// covariances included. `plane` is step 1's, needed where apex is by_plane.
Patch bounded_patch(const Samples& samples, const SurfaceFit& fit, const MomentVector& moments,
                    const JointCovariance& cov_joint, const PatchPlan& plan,
                    const SurfaceFit* plane = nullptr);

// A sphere or circular cylinder seen along z_l ends 1/|kappa| from its apex: a longer d is cut to that, its
// covariance stays. What was cut; nothing where nothing was.
struct Clamped {
  double d, limit;  // m
};
std::optional<Clamped> clamp_to_surface(Patch& patch);

}  // namespace patchlab
