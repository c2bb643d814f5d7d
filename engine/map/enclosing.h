// The bound of a fused patch: the smallest of its type that holds the outlines of everything seen of it. It
// is derived from them, and no part of the Kalman state.
#pragma once

#include <span>

#include "engine/patch/patch.h"

namespace patchlab {

// The same surface described by other axes and another apex: R <- R Q, c <- c + R p, with the covariance. Q
// and p must move the surface in itself: anything in the plane, a roll of a sphere or cylinder, a slide of a
// cylinder.
Patch described_anew(const Patch& patch, const Matrix3d& Q, const Vector3d& p);

// `patch` with the smallest bound of its type that holds the outlines of `seen` (in the same frame); where
// the surface slides in itself the apex goes to its middle. A circle is smallest to a thousandth; a quad is
// the smallest with its sides along those of the outlines' hull. Variances of the bound: the largest seen.
// Precondition: `seen` is not empty.
Patch with_enclosing_bound(const Patch& patch, std::span<const Patch> seen);

}  // namespace patchlab
