// Kalman steps on the manifold of surfaces.
//
// The chart (d, kappa, w, t) of a patch bends where it is loose: the spin w_z is known by the difference of
// the curvatures alone (a step of it moves H_xy by (kappa_x - kappa_y) w_z), and an apex that slides along
// its surface turns the axis with it. The quadric's ten coefficients in one plane (engine/map/common_form.h)
// are what heights measure, hardly bend, and go from one plane to another linearly. So a step is made, and
// its covariance held, there; the patch is the one whose quadric it is.
#pragma once

#include "engine/patch/patch.h"

namespace patchlab {

// How many directions a surface can change in: all of them (its parameters, less those that move it in
// itself), and those that its 2-jet at one point shows.
struct SurfaceDof {
  int all, jet;
};
SurfaceDof surface_dof(const PatchTypeRow& type);

// The patch after the step `x` of its local chart, with covariance `P` in the chart before: both by the
// quadric in `plane` (near the patch, z along its normal). Of what leaves the surface as it is, bounds among
// it, the chart's own step is taken. An elliptic paraboloid may become hyperbolic, and the other way round.
Patch corrected(const Patch& patch, const PatchVector& x, const PatchMatrix& P, const Pose& plane);

}  // namespace patchlab
