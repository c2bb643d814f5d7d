#include "engine/region/pixel_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "engine/region/observe.h"

namespace patchlab {
namespace {

using testing::Each;

// A wall 2 m away with a box 1 m away before columns 4 to 7, as a camera of 100 pixels focal length sees it.
Scan wall_and_box() {
  Scan scan;
  scan.width = 12;
  scan.height = 8;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 12; ++column) {
      const float z = column >= 4 && column < 8 ? 1.0F : 2.0F;
      scan.positions.emplace_back(z * static_cast<float>(column - 6) / 100.0F,
                                  z * static_cast<float>(row - 4) / 100.0F, z);
    }
  }
  scan.finite.assign(scan.size(), 1);
  scan.finite_count = scan.size();
  return scan;
}

std::vector<std::uint32_t> ids_of(const Scan& scan) {
  std::vector<std::uint32_t> ids(scan.size());
  std::iota(ids.begin(), ids.end(), 0u);
  return ids;
}

const std::vector<double> sure(96, 1e-3);

TEST(PixelEdges, LieOnBothSidesOfAJump) {
  const Scan scan = wall_and_box();
  const std::vector<std::uint8_t> at_edge = pixel_edges(scan, ids_of(scan), sure);
  ASSERT_EQ(at_edge.size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::size_t column = i % 12;
    const bool beside = column == 3 || column == 4 || column == 7 || column == 8;
    EXPECT_EQ(at_edge[i] == 1, beside) << "column " << column;
  }
}

TEST(PixelEdges, LieAroundMissingPixels) {
  Scan scan = wall_and_box();
  const std::uint32_t hole = 4 * 12 + 1;
  scan.positions[hole].z() = std::numeric_limits<float>::quiet_NaN();
  scan.finite[hole] = 0;
  const std::vector<std::uint32_t> ids = {3 * 12 + 0, 5 * 12 + 2, 4 * 12 + 10};
  EXPECT_THAT(pixel_edges(scan, ids, sure), testing::ElementsAre(1, 1, 0));
}

TEST(PixelEdges, AreNotWhatNoiseAloneMayDo) {
  const Scan scan = wall_and_box();
  EXPECT_THAT(pixel_edges(scan, ids_of(scan), std::vector<double>(scan.size(), 0.2)), Each(0));
}

TEST(PixelEdges, AreUnknownWithoutAGrid) {
  Scan scan = wall_and_box();
  scan.width = static_cast<std::uint32_t>(scan.size());
  scan.height = 1;
  EXPECT_TRUE(pixel_edges(scan, ids_of(scan), sure).empty());
}

TEST(PixelEdges, AreMarkedUnderASensorModelOnly) {
  Scan scan = wall_and_box();
  const Result<Observations> observations = observe(scan, {"kinect1", StereoNoise{}, false}, ids_of(scan));
  ASSERT_TRUE(observations.ok());
  EXPECT_EQ(observations->at_edge, pixel_edges(scan, ids_of(scan), sure));
  scan.covariances.assign(scan.size(), {1e-6F, 0, 0, 1e-6F, 0, 1e-6F});
  const Result<Observations> stated = observe(scan, *noise_model("from_file"), ids_of(scan));
  ASSERT_TRUE(stated.ok());
  EXPECT_TRUE(stated->at_edge.empty());
}

}  // namespace
}  // namespace patchlab
