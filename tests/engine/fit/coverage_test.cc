#include "engine/fit/coverage.h"

#include <gtest/gtest.h>

#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using test::SeededRandom;

Patch plate(double d_x, double d_y) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::rectangle);
  const PatchMatrix cov = 1e-8 * PatchMatrix::Identity(type.size(), type.size());
  return make_patch(type, {type.boundary, Vector2d(d_x, d_y)}, Eigen::VectorXd(), Matrix3d::Identity(),
                    Vector3d::Zero(), cov);
}

// Evenly drawn over x in [from, to] and y in [-half, half].
std::vector<Vector2d> strewn(Random& random, std::size_t points, double from, double to, double half) {
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < points; ++i) {
    const double x = random.uniform(from, to), y = random.uniform(-half, half);
    out.emplace_back(x, y);
  }
  return out;
}

double coverage_by(const Patch& patch, const std::vector<Vector2d>& feet) {
  return coverage(patch, feet, std::vector<double>(feet.size(), 1.0));
}

TEST(Coverage, IsFullWherePointsLieAllOver) {
  SeededRandom random;
  EXPECT_GT(coverage_by(plate(0.1, 0.1), strewn(random, 1000, -0.1, 0.1, 0.1)), 0.95);
}

TEST(Coverage, IsTheShareOfThePatchThatPointsLieOn) {
  SeededRandom random;
  EXPECT_NEAR(coverage_by(plate(0.1, 0.1), strewn(random, 1000, -0.1, 0.0, 0.1)), 0.5, 0.1);
}

TEST(Coverage, CountsWhatAnOutlineWithoutWidthWouldTakeForeverToCount) {
  SeededRandom random;
  const std::vector<Vector2d> feet = strewn(random, 300, -0.1, 0.1, 0.1);
  for (const double length : {1e3, 1e9, 1e300}) {
    const double covered = coverage_by(plate(length, 1e-12), feet);
    EXPECT_GE(covered, 0.0) << length;
    EXPECT_LE(covered, 0.5) << length << ": its points do not fill it";
  }
}

}  // namespace
}  // namespace patchlab
