#include "engine/scan/scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace patchlab {
namespace {

TEST(Scan, RotationIsOfTheQuaternionXyzw) {
  const double c = std::numbers::sqrt2 / 2;
  Viewpoint viewpoint;
  EXPECT_EQ(rotation(viewpoint), Eigen::Matrix3d::Identity());
  viewpoint.quaternion_xyzw = {0, 0, c, c};  // a quarter turn about z
  EXPECT_TRUE((rotation(viewpoint) * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY()));
  viewpoint.quaternion_xyzw = {1, 0, 0, 0};  // half a turn about x
  EXPECT_TRUE((rotation(viewpoint) * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitZ()));
}

TEST(Scan, RotationOfAnUnevenQuaternionIsStillARotation) {
  Viewpoint viewpoint;
  viewpoint.quaternion_xyzw = {0.1, 0.2, 0.3, 0.93};
  EXPECT_TRUE((rotation(viewpoint) * rotation(viewpoint).transpose()).isIdentity(1e-14));
}

TEST(Scan, BoundsHoldTheFinitePointsInTheFrameOfTheFile) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Scan scan;
  EXPECT_FALSE(bounds(scan));
  scan.origin = {1000, 0, -2};
  scan.positions = {{1, 5, 3}, {nan, nan, nan}, {-1, 6, 3}};
  scan.finite = {1, 0, 1};
  scan.finite_count = 2;
  const std::optional<Bounds> box = bounds(scan);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->min, Eigen::Vector3d(999, 5, 1));
  EXPECT_EQ(box->max, Eigen::Vector3d(1001, 6, 1));
}

TEST(Scan, IsOrganisedWhenItsGridHasTwoSides) {
  Scan scan;
  scan.width = 1;
  scan.height = 100;
  EXPECT_FALSE(scan.organized());
  scan.width = 100;
  EXPECT_TRUE(scan.organized());
  scan.height = 1;
  EXPECT_FALSE(scan.organized());
}

}  // namespace
}  // namespace patchlab
