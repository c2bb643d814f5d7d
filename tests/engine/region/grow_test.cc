#include "engine/region/grow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/engine/region/layers.h"

namespace patchlab {
namespace {

constexpr std::uint32_t sheet_middle = sheet_points / 2;

Scan two_sheets() {
  Scan scan;
  add_sheet(scan, 0.0);
  add_sheet(scan, -0.1);
  return scan;
}

PointIds range(std::uint32_t from, std::uint32_t to) {
  PointIds ids(to - from);
  std::iota(ids.begin(), ids.end(), from);
  return ids;
}

TEST(Invert, GivesTheOtherFinitePoints) {
  Scan scan = two_sheets();
  EXPECT_EQ(invert(scan, range(0, sheet_points)), range(sheet_points, 2 * sheet_points));
  scan.finite[sheet_points] = 0;
  EXPECT_EQ(invert(scan, range(0, sheet_points)), range(sheet_points + 1, 2 * sheet_points));
  EXPECT_TRUE(invert(scan, range(0, 2 * sheet_points)).empty());
}

TEST(Grow, AddsTheRingAround) {
  const Scan scan = two_sheets();
  const PointIds ring = grow(scan, {sheet_middle}, 1);
  EXPECT_THAT(ring, testing::ElementsAre(sheet_middle - sheet_side - 1, sheet_middle - sheet_side,
                                         sheet_middle - sheet_side + 1, sheet_middle - 1, sheet_middle,
                                         sheet_middle + 1, sheet_middle + sheet_side - 1,
                                         sheet_middle + sheet_side, sheet_middle + sheet_side + 1));
  EXPECT_EQ(grow(scan, {sheet_middle}, 3).size(), 49u);
  EXPECT_EQ(grow(scan, ring, 1), grow(scan, {sheet_middle}, 2));
}

TEST(Shrink, TakesTheRingOff) {
  const Scan scan = two_sheets();
  EXPECT_EQ(shrink(scan, grow(scan, {sheet_middle}, 3), 1), grow(scan, {sheet_middle}, 2));
  EXPECT_EQ(shrink(scan, grow(scan, {sheet_middle}, 3), 3), PointIds{sheet_middle});
  EXPECT_TRUE(shrink(scan, {sheet_middle}, 1).empty());
}

TEST(Flood, TakesTheSheetThatTheSeedIsOn) {
  const Scan scan = two_sheets();
  const Result<PointIds> ids = flood(scan, {0.01, 0.02, -0.001}, {});
  ASSERT_TRUE(ids);
  EXPECT_EQ(*ids, range(0, sheet_points));
}

TEST(Flood, StopsAtAFold) {
  Scan scan;
  add_sheet(scan, 0.0, 1.4);
  const Result<PointIds> ids = flood(scan, {-0.05, 0.0, 0.0}, {});
  ASSERT_TRUE(ids);
  EXPECT_GT(ids->size(), 0.40 * sheet_points);
  EXPECT_LT(ids->size(), 0.60 * sheet_points);
  for (const std::uint32_t id : *ids) EXPECT_LE(scan.positions[id].z(), 0.02F);
}

TEST(Flood, GoesRoundASmoothBendUpToItsLimit) {
  Scan scan;  // a half cylinder of 0.1 m radius
  for (int row = 0; row < 60; ++row) {
    for (int i = 0; i <= 100; ++i) {
      const double angle = 0.0314159 * i;
      add_point(scan, {0.1 * std::cos(angle), 0.003 * row, 0.1 * std::sin(angle)});
    }
  }
  const Eigen::Vector3d top(0.0, 0.09, 0.1);
  FloodLimits limits;
  limits.from_seed = 0.5;
  const Result<PointIds> cap = flood(scan, top, limits);
  limits.from_seed.reset();
  const Result<PointIds> all = flood(scan, top, limits);
  ASSERT_TRUE(cap && all);
  EXPECT_EQ(all->size(), scan.size());
  EXPECT_NEAR(static_cast<double>(cap->size()), static_cast<double>(scan.size()) / 3.14159,
              0.08 * static_cast<double>(scan.size()));
}

TEST(Linked, TakesAllThatIsSmoothlyConnectedWithAnyPoint) {
  const Scan scan = two_sheets();
  const Result<PointIds> one = linked(scan, {3, 4}), both = linked(scan, {3, sheet_points + 5});
  ASSERT_TRUE(one && both);
  EXPECT_EQ(*one, range(0, sheet_points));
  EXPECT_EQ(*both, range(0, 2 * sheet_points));
}

TEST(Linked, CanBeCancelled) {
  const Result<PointIds> ids = linked(two_sheets(), {3}, [](double) { return false; });
  ASSERT_FALSE(ids);
  EXPECT_EQ(ids.error().code, ErrorCode::cancelled);
}

TEST(Grown, OfNothingIsNothing) {
  const Scan scan = two_sheets();
  EXPECT_TRUE(grow(scan, {}, 2).empty());
  EXPECT_TRUE(shrink(scan, {}, 2).empty());
  EXPECT_TRUE(linked(scan, {})->empty());
  EXPECT_TRUE(flood({}, {0, 0, 0}, {})->empty());
}

}  // namespace
}  // namespace patchlab
