#include "engine/region/observe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace patchlab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Scan four_points() {
  Scan scan;
  scan.file = "four.pcd";
  scan.format = "pcd";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  scan.positions = {{0.1F, 0, 1}, {0, 0.2F, 1}, {nan, 0, 1}, {0, 0, 2}};
  scan.finite = {1, 1, 0, 1};
  scan.finite_count = 3;
  scan.width = 4;
  return scan;
}

const std::vector<std::uint32_t> kAll = {0, 1, 2, 3};
const NoiseModel kFromFile{"from_file", NoiseFromFile{}, false};
const NoiseModel kStereo{"kinect1", StereoNoise{}, false};

TEST(Observe, LeavesOutPointsThatAreNotFiniteAndSaysWhichRemain) {
  std::vector<std::uint32_t> kept;
  const Result<Observations> observations = observe(four_points(), kStereo, kAll, &kept);
  ASSERT_TRUE(observations.ok());
  EXPECT_THAT(kept, ElementsAre(0u, 1u, 3u));
  EXPECT_EQ(observations->size(), 3u);
  EXPECT_EQ(observations->covariances.size(), 3u);
  EXPECT_EQ(observations->points[2], Eigen::Vector3d(0, 0, 2));
}

TEST(Observe, StaysInTheFrameOfTheFileFarFromItsOrigin) {
  Scan scan = four_points();
  scan.origin = {512345.25, 5403210.5, 301.0};
  scan.viewpoints.assign(4, Eigen::Vector3f(1, 2, 3));
  const Result<Observations> observations = observe(scan, kStereo, kAll);
  ASSERT_TRUE(observations.ok());
  EXPECT_EQ(observations->points[2], Eigen::Vector3d(512345.25, 5403210.5, 303.0));
  EXPECT_EQ(observations->viewpoints[2], Eigen::Vector3d(512346.25, 5403212.5, 304.0));
}

TEST(Observe, TakesTheCovariancesOfTheFileAsConstants) {
  Scan scan = four_points();
  scan.covariances.assign(4, {4e-6, 1e-6, 0, 2e-6, 0, 9e-6});
  const Result<Observations> observations = observe(scan, kFromFile, kAll);
  ASSERT_TRUE(observations.ok());
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 4, 1, 0, 1, 2, 0, 0, 0, 9).finished() * 1e-6;
  EXPECT_TRUE(observations->covariances[1].isApprox(expected, 1e-15));
  EXPECT_FALSE(observations->covariance_at);
}

TEST(Observe, RefusesACovarianceThatIsNotPositiveSemiDefiniteAndNamesThePoint) {
  Scan scan = four_points();
  scan.covariances.assign(4, {1e-6, 0, 0, 1e-6, 0, 1e-6});
  scan.covariances[3] = {1e-6, 2e-6, 0, 1e-6, 0, 1e-6};
  const Result<Observations> observations = observe(scan, kFromFile, kAll);
  ASSERT_FALSE(observations.ok());
  EXPECT_EQ(observations.error().code, ErrorCode::unreadable);
  EXPECT_THAT(observations.error().message, HasSubstr("four.pcd: the covariance of point 3"));
}

TEST(Observe, RefusesACovarianceThatIsNotFinite) {
  Scan scan = four_points();
  scan.covariances.assign(4, {1e-6, 0, 0, 1e-6, 0, 1e-6});
  scan.covariances[1][4] = std::numeric_limits<double>::quiet_NaN();
  const Result<Observations> observations = observe(scan, kFromFile, kAll);
  ASSERT_FALSE(observations.ok());
  EXPECT_THAT(observations.error().message, HasSubstr("point 1 (counted from 0) is not finite"));
}

TEST(Observe, AcceptsFlatCovariancesAndRoundingBelowZero) {
  Scan scan = four_points();
  scan.covariances.assign(4, {1e-6, 1e-6, 0, 1e-6, 0, 0});
  scan.covariances[1] = {1e-6, 0, 0, 1e-6, 0, -1e-17};
  scan.covariances[3] = {0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(observe(scan, kFromFile, kAll).ok());
}

TEST(Observe, IgnoresBadCovariancesOfPointsThatNobodyAskedFor) {
  Scan scan = four_points();
  scan.covariances.assign(4, {1e-6, 0, 0, 1e-6, 0, 1e-6});
  scan.covariances[0] = {-1, 0, 0, 1, 0, 1};
  EXPECT_TRUE(observe(scan, kFromFile, std::vector<std::uint32_t>{1, 3}).ok());
}

TEST(Observe, RefusesFromFileWhereTheFileHoldsNoCovariances) {
  const Result<Observations> observations = observe(four_points(), kFromFile, kAll);
  ASSERT_FALSE(observations.ok());
  EXPECT_EQ(observations.error().code, ErrorCode::usage);
}

TEST(Observe, GivesASensorModelThatOutlivesTheScan) {
  Observations observations;
  {
    const Scan scan = four_points();
    const NoiseModel model = kStereo;
    observations = *observe(scan, model, kAll);
  }
  const Eigen::Vector3d foot(0.05, 0.02, 1.5);
  EXPECT_TRUE(observations.covariance_at(0, foot).isApprox(covariance(kStereo, Viewpoint{}, foot), 1e-15));
  EXPECT_TRUE(
      observations.covariances[0].isApprox(covariance(kStereo, Viewpoint{}, observations.points[0]), 1e-15));
}

TEST(Observe, PointsTheCovarianceOfAMergedCloudAlongEachRay) {
  Scan scan = four_points();
  scan.viewpoints = {{2, 0, 1}, {0, 3, 1}, {0, 0, 0}, {0, 0, 0}};
  const Result<Observations> observations = observe(scan, kStereo, kAll);
  ASSERT_TRUE(observations.ok());
  EXPECT_FALSE(observations->optical_axis.has_value());
  const Eigen::Matrix3d& sideways = observations->covariances[0];
  EXPECT_GT(sideways(0, 0), 10.0 * sideways(2, 2))
      << "the sensor looks along -x: x is the uncertain direction";
  EXPECT_EQ(covariance(kStereo, sensor_of(scan, 0), scan.point(0)), sideways);
}

TEST(Observe, GivesTheOpticalAxisOfACameraAndOfAPointTableAlone) {
  Scan scan = four_points();
  EXPECT_FALSE(observe(scan, kStereo, kAll)->optical_axis.has_value());
  scan.format = "csv";
  EXPECT_EQ(observe(scan, kStereo, kAll)->optical_axis, Eigen::Vector3d(0, 0, 1));
  scan.format = "pcd";
  scan.width = scan.height = 2;
  scan.viewpoint.quaternion_xyzw = {1, 0, 0, 0};
  EXPECT_TRUE(observe(scan, kStereo, kAll)->optical_axis->isApprox(Eigen::Vector3d(0, 0, -1), 1e-12));
}

}  // namespace
}  // namespace patchlab
