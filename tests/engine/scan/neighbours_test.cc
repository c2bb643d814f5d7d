#include "engine/scan/neighbours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Random points, every seventh without a measurement.
Scan random_scan(std::size_t size) {
  test::SeededRandom random;
  Scan scan;
  scan.width = static_cast<std::uint32_t>(size);
  for (std::size_t i = 0; i < size; ++i) {
    const bool finite = i % 7 != 3;
    scan.positions.push_back(finite ? Eigen::Vector3f(random.normal3().cast<float>())
                                    : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    scan.finite.push_back(finite ? 1 : 0);
    scan.finite_count += finite ? 1 : 0;
  }
  return scan;
}

// Distances of all finite points, nearest first.
std::vector<Neighbour> by_brute_force(const Scan& scan, const Eigen::Vector3f& position) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i]) all.push_back({i, (scan.positions[i] - position).squaredNorm()});
  }
  std::ranges::sort(all, {}, &Neighbour::squared_distance);
  return all;
}

std::vector<std::uint32_t> ids(const std::vector<Neighbour>& neighbours) {
  std::vector<std::uint32_t> result;
  for (const Neighbour& neighbour : neighbours) result.push_back(neighbour.id);
  return result;
}

TEST(NeighbourIndex, FindsTheNearestOfAllFinitePointsInTheirOrder) {
  const Scan scan = random_scan(500);
  const NeighbourIndex index(scan);
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < scan.size(); i += 20) {
    const Eigen::Vector3f position = scan.finite[i] ? scan.positions[i] : Eigen::Vector3f(0.3F, 0, 0);
    std::vector<Neighbour> expected = by_brute_force(scan, position);
    expected.resize(12);
    index.nearest(position, 12, found);
    EXPECT_EQ(ids(found), ids(expected)) << i;
  }
}

TEST(NeighbourIndex, FindsTheWholeBall) {
  const Scan scan = random_scan(500);
  std::vector<Neighbour> expected = by_brute_force(scan, {0, 0.2F, 0}), found;
  std::erase_if(expected, [](const Neighbour& neighbour) { return neighbour.squared_distance > 0.49F; });
  ASSERT_GT(expected.size(), 10U);
  NeighbourIndex(scan).within({0, 0.2F, 0}, 0.7, found);
  EXPECT_EQ(ids(found), ids(expected));
  EXPECT_NEAR(found[3].squared_distance, expected[3].squared_distance, 1e-6);
}

TEST(NeighbourIndex, GivesNoMoreThanThereAre) {
  std::vector<Neighbour> found;
  const Scan scan = random_scan(5);
  NeighbourIndex(scan).nearest({0, 0, 0}, 100, found);
  EXPECT_EQ(found.size(), scan.finite_count);
  const NeighbourIndex nothing{Scan{}};
  nothing.nearest({0, 0, 0}, 3, found);
  EXPECT_THAT(found, IsEmpty());
  nothing.within({0, 0, 0}, 3.0, found);
  EXPECT_THAT(found, IsEmpty());
}

Scan grid(std::uint32_t width, std::uint32_t height) {
  Scan scan = random_scan(0);
  scan.width = width;
  scan.height = height;
  scan.positions.assign(width * height, Eigen::Vector3f::Zero());
  scan.finite.assign(width * height, 1);
  return scan;
}

TEST(GridNeighbours, AreTheFinitePixelsAround) {
  Scan scan = grid(4, 3);
  std::vector<std::uint32_t> found;
  grid_neighbours(scan, 5, 1, found);
  EXPECT_THAT(found, ElementsAre(0, 1, 2, 4, 6, 8, 9, 10));
  scan.finite[1] = 0;
  grid_neighbours(scan, 5, 1, found);
  EXPECT_THAT(found, ElementsAre(0, 2, 4, 6, 8, 9, 10));
}

TEST(GridNeighbours, StopAtTheBorder) {
  const Scan scan = grid(4, 3);
  std::vector<std::uint32_t> found;
  grid_neighbours(scan, 0, 1, found);
  EXPECT_THAT(found, ElementsAre(1, 4, 5));
  grid_neighbours(scan, 11, 1, found);
  EXPECT_THAT(found, ElementsAre(6, 7, 10));
  grid_neighbours(scan, 3, 9, found);
  EXPECT_EQ(found.size(), 11U);
}

}  // namespace
}  // namespace patchlab
