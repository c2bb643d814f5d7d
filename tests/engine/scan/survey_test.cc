#include "engine/scan/survey.h"

#include <gtest/gtest.h>

#include <limits>

namespace patchlab {
namespace {

Scan scan_of(std::vector<Eigen::Vector3f> positions) {
  Scan scan;
  scan.positions = std::move(positions);
  for (const Eigen::Vector3f& position : scan.positions) {
    scan.finite.push_back(position.allFinite() ? 1 : 0);
    scan.finite_count += scan.finite.back();
  }
  return scan;
}

std::vector<Eigen::Vector3f> row(int points) {
  std::vector<Eigen::Vector3f> positions;
  for (int i = 0; i < points; ++i) positions.emplace_back(0.01F * static_cast<float>(i), 0.F, 1.F);
  return positions;
}

TEST(Survey, CountsPointsThatAreThereAgain) {
  std::vector<Eigen::Vector3f> positions = row(50);
  positions.insert(positions.end(), {positions[3], positions[7], positions[3]});
  EXPECT_EQ(survey(scan_of(positions)).duplicates, 3u);
  EXPECT_EQ(survey(scan_of(row(50))).duplicates, 0u);
}

TEST(Survey, CountsPointsFarFromMost) {
  std::vector<Eigen::Vector3f> positions = row(100);  // nine tenths within 0.45 m of the middle
  positions.emplace_back(100.F, 0.F, 1.F);
  positions.emplace_back(0.F, -5.F, 1.F);
  positions.emplace_back(0.F, -3.F, 1.F);
  EXPECT_EQ(survey(scan_of(positions)).far_outliers, 2u);
}

TEST(Survey, LeavesPointsThatAreNoneAside) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Survey found = survey(scan_of({{nan, nan, nan}, {nan, nan, nan}}));
  EXPECT_EQ(found.duplicates, 0u);
  EXPECT_EQ(found.far_outliers, 0u);
}

}  // namespace
}  // namespace patchlab
