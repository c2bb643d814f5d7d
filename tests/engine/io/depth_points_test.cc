#include "engine/io/depth_points.h"

#include <gtest/gtest.h>

#include <cstring>

#include "engine/base/random.h"

namespace patchlab {
namespace {

struct Unprojected {
  std::vector<Eigen::Vector3f> positions;
  std::vector<std::uint8_t> finite;
  std::size_t count = 0;
};

Unprojected taken(decltype(unproject)& function, const DepthPixels& pixels) {
  Unprojected found;
  found.positions.resize(pixels.samples.size());
  found.finite.resize(pixels.samples.size(), 7);
  found.count = function(pixels, found.positions.data(), found.finite.data());
  return found;
}

std::vector<std::uint16_t> some_depths(std::size_t count) {
  Random random(17);
  std::vector<std::uint16_t> raw(count);
  for (std::uint16_t& depth : raw)
    depth = random.uniform() < 0.2 ? std::uint16_t{0} : static_cast<std::uint16_t>(1 + random.index(65535));
  return raw;
}

TEST(Unproject, FollowsThePinholeAndLeavesHolesOut) {
  const std::vector<std::uint16_t> raw = some_depths(7 * 11);
  const Intrinsics pinhole = {525.0, 520.0, 3.2, 5.1, 0, 0, false};
  const Unprojected found = taken(unproject, {raw, 7, pinhole, 5000.0});
  std::size_t count = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    EXPECT_EQ(found.finite[i], raw[i] > 0 ? 1 : 0);
    EXPECT_EQ(found.positions[i].hasNaN(), raw[i] == 0);
    count += found.finite[i];
    if (raw[i] == 0) continue;
    const double z = raw[i] / 5000.0, u = static_cast<double>(i % 7), v = static_cast<double>(i / 7);
    const Eigen::Vector3d expected((u - 3.2) * z / 525.0, (v - 5.1) * z / 520.0, z);
    EXPECT_LT((found.positions[i].cast<double>() - expected).norm(), 1e-7 * expected.norm());
  }
  EXPECT_EQ(found.count, count);
}

TEST(Unproject, GivesTheSameBytesFromEveryKernelForAnyWidthAndCamera) {
  for (const std::size_t width : {1u, 3u, 4u, 5u, 8u, 31u, 640u}) {
    const std::vector<std::uint16_t> raw = some_depths(width * 9);
    for (const double fx : {525.0, 1e-40}) {  // beyond what a float holds
      const DepthPixels pixels = {raw, width, {fx, 520.0, 3.2, 5.1, 0, 0, false}, 1000.0};
      const Unprojected a = taken(unproject, pixels), b = taken(unproject_plain, pixels);
      EXPECT_EQ(std::memcmp(a.positions.data(), b.positions.data(), 12 * raw.size()), 0) << width;
      EXPECT_EQ(a.finite, b.finite);
      EXPECT_EQ(a.count, b.count);
    }
  }
}

}  // namespace
}  // namespace patchlab
