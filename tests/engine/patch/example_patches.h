// Patches of all ten types and both signs of curvature, for laws that hold for every one of them.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/patch/patch.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {

using Eigen::VectorXd;

// A row of Table I and the sign of its (first) curvature: +1 concave, -1 convex.
struct PatchCase {
  const PatchTypeRow* type;
  int sign;
};
std::vector<PatchCase> all_cases();
std::vector<PatchCase> cases_where(bool (*holds)(const PatchTypeRow&));
void PrintTo(const PatchCase& patch_case, std::ostream* out);
std::string case_name(const testing::TestParamInfo<PatchCase>& info);  // "SphereCircleConvex"

// Random shape (sizes 5 to 20 cm, |kappa| d from 0.2 to 0.8), position, orientation of the given |r| (|r_xy|
// for 5-DoF types) and covariances.
Patch random_patch(Random& random, const PatchCase& patch_case, double rotation);
Patch random_patch(Random& random, const PatchCase& patch_case);  // |r| up to 3

// The local chart as it is defined in engine/patch/patch.h: the patch moved by e = (d, kappa, w or tilt, t),
// and the e that leads from `base` to a patch next to it.
Patch moved_in_chart(const Patch& base, const VectorXd& e);
VectorXd chart_difference(const Patch& base, const Patch& moved);

// A point of the bounded patch: u uniform within the boundary, and the point in the world.
Vector2d random_u(Random& random, const Patch& patch);
Vector3d world_point(const Patch& patch, const Vector2d& u);

// Two covariances are equal, each entry relative to its standard deviations.
testing::AssertionResult same_covariance(const PatchMatrix& a, const PatchMatrix& b, double tolerance);
// The same patch to rounding: type, parameters (rotations as matrices) and local covariance.
testing::AssertionResult same_patch(const Patch& a, const Patch& b);

}  // namespace patchlab::test
