// Steps 6 to 9 themselves: the frame, centre and bound of a patch on its surface.
#pragma once

#include "engine/fit/dual.h"
#include "engine/fit/fit_boundary.h"

namespace patchlab {

// Where a patch lies, in the moving axes of its surface fit, and its bound's lengths.
struct Placed {
  Dual3 x, y, z, c;
  Dual2 d;
};

// What it is placed by: the surface and the moments, with the frames at rest as constants.
struct Ingredients {
  Dual kappa;          // 1/m, the first curvature
  Dual3 w, t;          // chart of the surface, at zero
  Dual3 plane_normal;  // of step 1, in the surface's axes at rest
  Dual3 mean;          // moments of the foot points
  Eigen::Matrix<Dual, 3, 3> second;
  Matrix3d R;  // world_from_surface at rest
};

Placed place(const Ingredients& from, const PatchPlan& plan);

}  // namespace patchlab
