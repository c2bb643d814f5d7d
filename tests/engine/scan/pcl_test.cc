#include "engine/scan/pcl.h"

#include <gtest/gtest.h>

namespace patchlab {
namespace {

Scan sample_scan() {
  Scan scan;
  scan.origin = {1.0, 2.0, -4.0};
  for (int i = 0; i < 6; ++i) {
    const float x = 0.25f * static_cast<float>(i);
    scan.positions.emplace_back(x, -x, i == 4 ? NAN : 1.0f);
    scan.finite.push_back(i == 4 ? 0 : 1);
    scan.covariances.push_back({1.0 + i, 0.5, 0.25, 2.0, -0.5, 3.0});
  }
  scan.finite_count = 5;
  scan.width = 3;
  scan.height = 2;
  scan.viewpoint = {Eigen::Vector3d(0.5, -0.25, 2.0), {0.0, 0.6, 0.0, 0.8}, true};
  return scan;
}

TEST(Pcl, KeepsPointsGridCovariancesAndViewpointThereAndBack) {
  const Scan before = sample_scan(), after = from_pcl(to_pcl(before));
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after.finite[i], before.finite[i]);
    if (before.finite[i]) {
      EXPECT_EQ(after.point(i), before.point(i));
    }
    EXPECT_EQ(after.covariances[i], before.covariances[i]);
  }
  EXPECT_EQ(after.finite_count, 5u);
  EXPECT_EQ(after.width, 3u);
  EXPECT_EQ(after.height, 2u);
  EXPECT_EQ(after.viewpoint.position, before.viewpoint.position);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(after.viewpoint.quaternion_xyzw[k], before.viewpoint.quaternion_xyzw[k], 1e-7);
  EXPECT_TRUE(after.viewpoint.stated);
}

TEST(Pcl, TakesCloudsWithoutCovariancesAsTheyAre) {
  Scan bare = sample_scan();
  bare.covariances.clear();
  EXPECT_TRUE(from_pcl(to_pcl(bare)).covariances.empty());
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.emplace_back(1.0f, 2.0f, 3.0f);
  const Scan scan = from_pcl(cloud);
  ASSERT_EQ(scan.size(), 1u);
  EXPECT_EQ(scan.point(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_FALSE(scan.viewpoint.stated);
  EXPECT_TRUE(scan.covariances.empty());
}

}  // namespace
}  // namespace patchlab
