// Steps 5 to 9: where the bounded patch lies on its surface, how large it is, and what becomes of the
// covariance.
//
// All of it is one function of the surface and of the moments of its foot points, written once for any scalar
// and differentiated automatically; the covariance follows by the chain rule (fitting.md section 1.3).
#pragma once

#include <optional>

#include "engine/base/result.h"
#include "engine/fit/moments.h"
#include "engine/patch/patch.h"

namespace patchlab {

// How moments become lengths: the half-axis is factor * sqrt(variance) in each case.
struct BoundaryScale {
  double ellipse;    // per axis, curved surfaces about c
  double circle;     // of the mean variance per axis (v_x + v_y)/2, or of the larger where `larger_axis`
  double rectangle;  // per axis, cylinders
  double plane_ellipse, plane_circle, plane_rectangle;  // of the principal variances of planes, step 9
  bool larger_axis = false;                             // steps 7 and 9 as printed: max of the two
};
// Uniform moments times sqrt(Gamma): exactly the fraction Gamma of a uniformly covered patch inside.
BoundaryScale extent_scale(double containment);
// lambda of step 4 and -ln(1 - Gamma) of Eq. (30). Precondition: containment < 1.
BoundaryScale paper_scale(double containment);

enum class Apex {
  over_centroid,  // sphere and cylinder: z_l passes through the centroid (fitting.md section 3, step 6)
  as_fitted,      // the paper's: the frame comes with the surface
};

// A direction in the plane known from elsewhere than the moments.
struct PlaneDirection {
  double angle;     // rad, of the patch's x axis in the frame of the fit
  double variance;  // rad^2
};

// The bounded patch of a surface fit. The world frame of `fit` is about samples.origin; the patch is in the
// frame of the points. Covariances included. `type` has the fit's surface (elliptic and hyperbolic by the
// signs of k).
Patch bounded_patch(const Samples& samples, const SurfaceFit& fit, const PatchTypeRow& type,
                    const MomentVector& moments, const JointMatrix& cov_joint, const BoundaryScale& scale,
                    Apex apex, const std::optional<PlaneDirection>& direction = std::nullopt);

}  // namespace patchlab
