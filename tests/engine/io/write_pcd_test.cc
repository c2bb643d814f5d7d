#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

Scan grid_with_everything() {
  Scan scan;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  scan.width = 2;
  scan.height = 2;
  scan.positions = {{0.1F, 0.2F, 0.3F}, {nan, nan, nan}, {-1.F, 1e-9F, 2.F}, {4.F, 5.F, 6.F}};
  scan.finite = {1, 0, 1, 1};
  scan.finite_count = 3;
  scan.colours = {{255, 128, 0}, {0, 0, 0}, {1, 2, 3}, {7, 8, 9}};
  scan.labels = {1, 0, 4000000000, 2};
  scan.covariances.assign(4, {1e-6, 1e-6 / 3.0, 0, 2e-6, -1e-9, 3e-6});
  scan.viewpoints = {{0, 0, 0.1F}, {0, 0, 0.2F}, {0, 0, 0.3F}, {0, 0, 0.4F}};
  scan.viewpoint.position = {0.1, -2.0 / 3.0, 1e-7};
  scan.viewpoint.quaternion_xyzw = {0.5, -0.5, 0.5, 0.5};
  scan.viewpoint.stated = true;
  return scan;
}

Scan read_back(const Scan& scan) {
  Result<Scan> read = read_pcd(write_pcd(scan), "written.pcd");
  if (!read) ADD_FAILURE() << read.error().message;
  return read ? *std::move(read) : Scan{};
}

TEST(WritePcd, ReaderGivesEverythingBackToTheBit) {
  const Scan scan = grid_with_everything(), read = read_back(scan);
  ASSERT_EQ(read.size(), 4U);
  EXPECT_TRUE(read.organized());
  EXPECT_EQ(read.finite, scan.finite);
  for (const std::size_t i : {0U, 2U, 3U}) EXPECT_EQ(read.positions[i], scan.positions[i]);
  EXPECT_EQ(read.colours, scan.colours);
  EXPECT_EQ(read.labels, scan.labels);
  EXPECT_EQ(read.covariances, scan.covariances);
  EXPECT_EQ(read.viewpoints, scan.viewpoints);
  EXPECT_EQ(read.viewpoint.position, scan.viewpoint.position);
  EXPECT_EQ(read.viewpoint.quaternion_xyzw, scan.viewpoint.quaternion_xyzw);
  EXPECT_TRUE(read.viewpoint.stated);
  EXPECT_TRUE(read.notices.empty());
}

TEST(WritePcd, WhatWasReadIsWrittenToTheSameBytesAgain) {
  const std::string bytes = write_pcd(grid_with_everything());
  EXPECT_EQ(write_pcd(*read_pcd(bytes, "written.pcd")), bytes);
}

TEST(WritePcd, MapCoordinatesAreWrittenAsDoubles) {
  Scan scan = grid_with_everything();
  scan.origin = {512768, 5403648, 0};
  const Scan read = read_back(scan);
  EXPECT_EQ(read.fields[0].type, "float64");
  for (const std::size_t i : {0U, 2U, 3U}) EXPECT_EQ(read.point(i), scan.point(i));
}

}  // namespace
}  // namespace patchlab
