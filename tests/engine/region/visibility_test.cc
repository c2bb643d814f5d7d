#include "engine/region/visibility.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "tests/engine/region/layers.h"

namespace patchlab {
namespace {

constexpr double thin = 0.002;  // m

// From z = 1 straight down: the sheets at z = 0 are 200 px wide.
ViewCamera above() {
  ViewCamera camera;
  camera.position = {0, 0, 1};
  camera.fov_y = 2 * std::atan(0.5);
  camera.viewport = {600, 1000};
  return camera;
}

int seen_among(const std::vector<std::uint8_t>& seen, int first, int count) {
  return std::accumulate(seen.begin() + first, seen.begin() + first + count, 0);
}

TEST(VisiblePoints, OfTwoSheetsAreThoseOfTheNearerOne) {
  Scan scan;
  add_sheet(scan, 0.0);
  add_sheet(scan, -0.1);
  const std::vector<std::uint8_t> seen = visible_points(scan, above(), thin);
  EXPECT_EQ(seen_among(seen, 0, sheet_points), sheet_points);
  EXPECT_EQ(seen_among(seen, sheet_points, sheet_points), 0);
}

TEST(VisiblePoints, DoNotDependOnWhichSheetComesFirst) {
  Scan scan;
  add_sheet(scan, -0.1);
  add_sheet(scan, 0.0);
  const std::vector<std::uint8_t> seen = visible_points(scan, above(), thin);
  EXPECT_EQ(seen_among(seen, 0, sheet_points), 0);
  EXPECT_EQ(seen_among(seen, sheet_points, sheet_points), sheet_points);
}

TEST(VisiblePoints, OfASheetSeenFromTheOtherSideAreTheOthers) {
  Scan scan;
  add_sheet(scan, 0.0);
  add_sheet(scan, -0.1);
  ViewCamera below = above();
  below.position = {0, 0, -1.1};
  below.quaternion_xyzw = {1, 0, 0, 0};
  const std::vector<std::uint8_t> seen = visible_points(scan, below, thin);
  EXPECT_EQ(seen_among(seen, 0, sheet_points), 0);
  EXPECT_EQ(seen_among(seen, sheet_points, sheet_points), sheet_points);
}

TEST(VisiblePoints, OfASlantedSheetAreAllOfIt) {
  Scan scan;
  add_sheet(scan, 0.0, 1.1);
  const std::vector<std::uint8_t> seen = visible_points(scan, above(), thin);
  EXPECT_EQ(seen_among(seen, 0, sheet_points), sheet_points);
}

TEST(VisiblePoints, OfANoisySheetAreAllOfItWhereTheNoiseIsKnown) {
  Scan scan;
  Random random(5);
  for (int i = 0; i < 40'000; ++i) {
    const double x = random.uniform(-0.2, 0.2), y = random.uniform(-0.2, 0.2);
    add_point(scan, {x, y, 0.005 * random.normal()});
  }
  const std::vector<std::uint8_t> exact = visible_points(scan, above(), 0.0);
  EXPECT_LT(std::accumulate(exact.begin(), exact.end(), 0), 38'000) << "else this tests nothing";
  const std::vector<std::uint8_t> seen = visible_points(scan, above(), 0.04);
  EXPECT_EQ(std::accumulate(seen.begin(), seen.end(), 0), 40'000);
}

TEST(VisiblePoints, AreInTheViewAndInFrontOfTheCamera) {
  Scan scan;
  add_point(scan, {0, 0, 0});
  add_point(scan, {0, 0, 2});      // behind
  add_point(scan, {0, 0, 0.999});  // before the near plane
  add_point(scan, {0.4, 0, 0});    // beside
  add_point(scan, {0.25, 0.45, 0});
  scan.positions.emplace_back(Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  scan.finite.push_back(0);
  EXPECT_EQ(visible_points(scan, above(), thin), (std::vector<std::uint8_t>{1, 0, 0, 0, 1, 0}));
}

TEST(VisiblePoints, AreTheSameInAParallelViewFromFarAway) {
  Scan scan;
  add_sheet(scan, 0.0);
  add_sheet(scan, -0.1);
  ViewCamera camera = above();
  camera.perspective = false;
  camera.height = 0.5;
  camera.position.z() = 50;
  const std::vector<std::uint8_t> seen = visible_points(scan, camera, thin);
  EXPECT_EQ(seen_among(seen, 0, sheet_points), sheet_points);
  EXPECT_EQ(seen_among(seen, sheet_points, sheet_points), 0);
}

TEST(VisiblePoints, OfNothingAreNone) { EXPECT_TRUE(visible_points({}, above(), thin).empty()); }

}  // namespace
}  // namespace patchlab
