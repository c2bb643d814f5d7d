#include "viewer/render/splat.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstdlib>

#include "tests/support/seeded_random.h"
#include "viewer/render/disk_stamp.h"

namespace patchlab::viewer {
namespace {

constexpr int width = 160, height = 120;

View view() {
  View view;
  view.view_from_local.setIdentity();
  view.clip_from_view << 1.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.02f, -0.202f, 0, 0, -1, 0;
  return view;
}
const PointFade no_fade{Eigen::Vector3f::Zero(), 1e6f, 1.0f};

Raster black() {
  Raster raster;
  raster.clear(width, height, {0, 0, 0, 1}, {0, 0, 0, 1});
  return raster;
}

PointsItem cloud(std::size_t count, float size) {
  test::SeededRandom random;
  const auto part = [&] { return static_cast<float>(random.uniform(-1.0, 1.0)); };
  auto positions = std::make_shared<std::vector<Eigen::Vector3f>>();
  auto colours = std::make_shared<std::vector<Rgba8>>();
  for (std::size_t i = 0; i < count; ++i) {
    positions->emplace_back(1.5f * part(), part(), -2.0f + part());
    colours->push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), 200, 255});
  }
  return {positions, colours, size};
}

// A disk as it is in the mathematics, before black.
double coverage(const Eigen::Vector2d& centre, double radius, int x, int y) {
  return std::clamp(radius + 0.5 - std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y()), 0.0, 1.0);
}

TEST(Splat, OnePointIsADiskWhereItIsSeenToAnEighthOfAPixel) {
  test::SeededRandom random;
  const auto part = [&] { return static_cast<float>(random.uniform(-1.05, 1.05)); };
  for (const float size : {1.0f, 2.0f, 3.5f, 12.0f})
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::Vector3f position(part() / 1.5f, part() / 2.0f, -1.0f);
      PointsItem item{std::make_shared<std::vector<Eigen::Vector3f>>(1, position),
                      std::make_shared<std::vector<Rgba8>>(1, Rgba8{255, 255, 255, 255}), size};
      Raster raster = black();
      splat(raster, item, view(), no_fade);
      const Eigen::Vector2d centre(0.5 * width * (1.5 * position.x() + 1),
                                   0.5 * height * (2.0 * position.y() + 1));
      double furthest = 0.0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double drawn = raster.colours[static_cast<std::size_t>(y * width + x)][0] / 255.0;
          furthest = std::max(furthest, std::abs(drawn - coverage(centre, 0.5 * size, x, y)));
        }
      EXPECT_LE(furthest, std::sqrt(2.0) / (2 * DiskStamp::kParts) + 1.0 / 255) << size << " " << position;
    }
}

TEST(Splat, TheNearestOfManyIsSeenWhateverTheirOrder) {
  const PointsItem item = cloud(20000, 3.0f);
  Raster raster = black();
  splat(raster, item, view(), no_fade);
  std::vector<std::uint32_t> depths(raster.depths.size(), ~0u);
  for (const Eigen::Vector3f& position : *item.positions) {
    const Eigen::Vector4f clip = view().clip_from_view * position.homogeneous();
    const int x = static_cast<int>(std::floor(0.5f * width * (clip.x() / clip.w() + 1)));
    const int y = static_cast<int>(std::floor(0.5f * height * (clip.y() / clip.w() + 1)));
    if (x < 0 || x >= width || y < 0 || y >= height) continue;
    const double ndc = clip.z() / clip.w();
    std::uint32_t& depth = depths[static_cast<std::size_t>(y * width + x)];
    depth = std::min(depth, static_cast<std::uint32_t>(0.5 * (ndc + 1.0) * 4294967040.0));
  }
  for (std::size_t i = 0; i < depths.size(); ++i)
    EXPECT_LE(raster.depths[i], std::min(depths[i], ~0u - 4096u) + 4096u) << i;
}

TEST(Splat, ThePictureIsTheSameByteForByteOnOneThread) {
  const PointsItem item = cloud(100000, 2.5f);
  Raster many = black(), one = black();
  splat(many, item, view(), no_fade);
  tbb::task_arena(1).execute([&] { splat(one, item, view(), no_fade); });
  EXPECT_EQ(many.colours, one.colours);
  EXPECT_EQ(many.depths, one.depths);
}

TEST(Splat, PointsThatAreNotNumbersOrAbsentLeaveNoTrace) {
  PointsItem item = cloud(3, 5.0f);
  item.positions = std::make_shared<std::vector<Eigen::Vector3f>>(
      std::vector<Eigen::Vector3f>{{NAN, 0, -1}, {0, 0, 1}, {0, 0, -1}});
  auto colours = std::make_shared<std::vector<Rgba8>>(3, Rgba8{255, 255, 255, 255});
  (*colours)[2][3] = 0;
  item.colours = colours;
  Raster raster = black();
  splat(raster, item, view(), no_fade);
  EXPECT_EQ(raster.colours, black().colours);
  EXPECT_EQ(raster.depths, black().depths);
}

}  // namespace
}  // namespace patchlab::viewer
