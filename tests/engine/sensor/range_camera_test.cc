#include "engine/sensor/range_camera.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cstring>
#include <string>
#include <vector>

#include "engine/sensor/noise_presets.h"

namespace patchlab {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

NoiseModel model(std::string_view specification) { return *noise_model(specification); }

// Far below what float positions resolve.
NoiseModel no_noise() { return model("isotropic:1e-12"); }

CastRay plane_at_depth(double z) {
  return [z](const Vector3d& origin, const Vector3d& direction) -> std::optional<Hit> {
    const double s = (z - origin.z()) / direction.z();
    return s > 0.0 ? std::optional(Hit{s, 0}) : std::nullopt;
  };
}

Camera small_camera() {
  Camera camera;
  camera.width = 8;
  camera.height = 6;
  camera.fx = 10.0;
  camera.fy = 12.0;
  camera.cx = 3.5;
  camera.cy = 2.5;
  return camera;
}

bool same_bits(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::memcmp(a.data(), b.data(), sizeof(float) * 3) == 0;
}

TEST(RangeCamera, SeesAPixelWhereThePinholeModelPutsIt) {
  const Camera camera = small_camera();
  const Scan scan = simulate_scan(camera, plane_at_depth(2.0), no_noise(), 1);
  ASSERT_EQ(scan.size(), 48u);
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const Vector3d expected(2.0 * (column - 3.5) / 10.0, 2.0 * (row - 2.5) / 12.0, 2.0);
      EXPECT_LT((scan.point(row * camera.width + column) - expected).norm(), 1e-6);
    }
  }
}

TEST(RangeCamera, GivesAnOrganisedScanWithItsViewpointStated) {
  Camera camera = small_camera();
  camera.pose.position = Vector3d(0.1, 0.2, 0.3);
  const Scan scan = simulate_scan(camera, plane_at_depth(2.0), no_noise(), 1);
  EXPECT_TRUE(scan.organized());
  EXPECT_EQ(scan.width, 8u);
  EXPECT_EQ(scan.height, 6u);
  EXPECT_TRUE(scan.viewpoint.stated);
  EXPECT_EQ(scan.viewpoint.position, camera.pose.position);
  EXPECT_EQ(scan.intrinsics, (std::array<double, 4>{10.0, 12.0, 3.5, 2.5}));
  EXPECT_EQ(scan.finite_count, 48u);
}

TEST(RangeCamera, GivesPointsInTheWorldFrame) {
  Camera camera = small_camera();
  const Eigen::Quaterniond looks_down(Eigen::AngleAxisd(3.0, Vector3d(0.8, 0.6, 0.0)));
  Eigen::Vector4d::Map(camera.pose.quaternion_xyzw.data()) = looks_down.coeffs();
  camera.pose.position = Vector3d(0.4, -0.3, 5.0);
  const Scan scan = simulate_scan(camera, plane_at_depth(1.0), no_noise(), 1);
  ASSERT_EQ(scan.finite_count, scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_NEAR(scan.point(i).z(), 1.0, 1e-6);
    const Vector3d seen = looks_down.conjugate() * (scan.point(i) - camera.pose.position);
    const Vector3d expected =
        pixel_direction(camera, static_cast<std::uint32_t>(i % 8), static_cast<std::uint32_t>(i / 8));
    EXPECT_LT((seen / seen.z() - expected).norm(), 1e-6);
  }
}

TEST(RangeCamera, LabelsObjectsFromOneAndLeavesMissesEmpty) {
  const CastRay left_half = [](const Vector3d&, const Vector3d& direction) -> std::optional<Hit> {
    return direction.x() < 0.0 ? std::optional(Hit{1.0, 6}) : std::nullopt;
  };
  const Scan scan = simulate_scan(small_camera(), left_half, no_noise(), 1);
  EXPECT_EQ(scan.finite_count, 24u);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool seen = i % 8 < 4;
    EXPECT_EQ(scan.labels[i], seen ? 7u : 0u);
    EXPECT_EQ(scan.finite[i], seen ? 1 : 0);
    EXPECT_EQ(scan.positions[i].allFinite(), seen);
    EXPECT_EQ(scan.positions[i].array().isNaN().all(), !seen);
  }
}

TEST(RangeCamera, GivesTheSameScanForTheSameSeedAndAnotherForAnother) {
  const NoiseModel kinect = model("kinect1");
  const Scan first = simulate_scan(small_camera(), plane_at_depth(2.0), kinect, 7);
  const Scan again = simulate_scan(small_camera(), plane_at_depth(2.0), kinect, 7);
  const Scan other = simulate_scan(small_camera(), plane_at_depth(2.0), kinect, 8);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(same_bits(first.positions[i], again.positions[i]));
    EXPECT_FALSE(same_bits(first.positions[i], other.positions[i]));
  }
}

TEST(RangeCamera, DrawsTheNoiseOfAPixelWhateverElseIsSeen) {
  const NoiseModel kinect = model("kinect1");
  const CastRay wall = plane_at_depth(2.0);
  const CastRay wall_with_hole = [&wall](const Vector3d& origin,
                                         const Vector3d& direction) -> std::optional<Hit> {
    return direction.norm() < 1.05 ? std::nullopt : wall(origin, direction);
  };
  const Scan whole = simulate_scan(small_camera(), wall, kinect, 7);
  const Scan holed = simulate_scan(small_camera(), wall_with_hole, kinect, 7);
  ASSERT_GT(holed.finite_count, 0u);
  ASSERT_LT(holed.finite_count, whole.finite_count);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(same_bits(whole.positions[i], holed.positions[i]), holed.finite[i] != 0);
  }
}

TEST(RangeCamera, DepthsAreMultiplesOfAStepAlongTheRay) {
  Camera camera = small_camera();
  camera.depth_step = 0.001;
  const NoiseModel kinect = model("kinect1");
  const Scan coarse = simulate_scan(camera, plane_at_depth(2.0), kinect, 7);
  const Scan fine = simulate_scan(small_camera(), plane_at_depth(2.0), kinect, 7);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const double steps = coarse.point(i).z() / camera.depth_step;
    EXPECT_NEAR(steps, std::round(steps), 1e-3);
    EXPECT_LE(std::abs(coarse.point(i).z() - fine.point(i).z()), 0.5e-3 + 1e-6);
    EXPECT_LT(coarse.point(i).cross(fine.point(i)).norm(), 1e-5) << "one ray";
  }
}

TEST(RangeCamera, LosesTheShareOfReturnsItIsToldTo) {
  Camera camera = small_camera();
  camera.width = 200;
  camera.height = 100;
  const Scan whole = simulate_scan(camera, plane_at_depth(2.0), model("kinect1"), 3);
  camera.missing = 0.2;
  const Scan holed = simulate_scan(camera, plane_at_depth(2.0), model("kinect1"), 3);
  EXPECT_NEAR(static_cast<double>(holed.finite_count), 16000.0, 4 * 57);  // 57: one standard deviation
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (holed.finite[i]) {
      EXPECT_TRUE(same_bits(whole.positions[i], holed.positions[i]));
    }
  }
}

// Mean and covariance of (point - truth) in units of the model: 0 and the identity where the camera is right.
class NoiseSample {
 public:
  NoiseSample(const Camera& camera, const NoiseModel& noise, const Vector3d& truth_sensor)
      : R_(rotation(camera.pose)),
        truth_(R_ * truth_sensor + camera.pose.position),
        whiten_(covariance_in_sensor(noise, truth_sensor).llt().matrixL().solve(Matrix3d::Identity())) {}

  void add(const Vector3d& point_world) {
    const Vector3d white = whiten_ * R_.transpose() * (point_world - truth_);
    sum_ += white;
    squares_ += white * white.transpose();
    ++count_;
  }
  int count() const { return count_; }
  Vector3d mean() const { return sum_ / count_; }
  Matrix3d covariance() const { return squares_ / count_ - mean() * mean().transpose(); }

 private:
  Matrix3d R_;
  Vector3d truth_;
  Matrix3d whiten_;
  int count_ = 0;
  Vector3d sum_ = Vector3d::Zero();
  Matrix3d squares_ = Matrix3d::Zero();
};

std::vector<std::string> every_model() {
  std::vector<std::string> models = {"stereo:f=400,baseline=0.05,pointing=0.9,disparity=0.05", "lidar",
                                     "lidar:range=0.01,angle=0.004", "isotropic:0.002", "estimated:0.003"};
  for (const NoisePreset& preset : noise_presets()) models.emplace_back(preset.name);
  return models;
}

class RangeCameraNoise : public testing::TestWithParam<std::string> {};

TEST_P(RangeCameraNoise, HasTheModelsCovarianceOverSeeds) {
  Camera camera;
  camera.width = camera.height = 1;
  camera.cx = -220.0;  // an oblique ray
  camera.cy = 150.0;
  Eigen::Vector4d::Map(camera.pose.quaternion_xyzw.data()) =
      Eigen::Vector4d(0.3, -0.5, 0.1, 0.8).normalized();
  camera.pose.position = Vector3d(0.2, 0.1, -0.4);
  const CastRay at_two_metres = [](const Vector3d&, const Vector3d&) { return Hit{2.0, 0}; };
  NoiseSample sample(camera, model(GetParam()), 2.0 * pixel_direction(camera, 0, 0));
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    sample.add(simulate_scan(camera, at_two_metres, model(GetParam()), seed).point(0));
  }
  EXPECT_LT(sample.mean().cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT((sample.covariance() - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.03) << sample.covariance();
}

TEST_P(RangeCameraNoise, HasTheModelsCovarianceOverPixels) {
  Camera camera;
  camera.width = 200;
  camera.height = 100;
  camera.fx = camera.fy = 1e9;  // so far away from the centre that all pixels share one oblique ray
  camera.cx = -0.4e9;
  camera.cy = 0.3e9;
  const CastRay at_two_metres = [](const Vector3d&, const Vector3d&) { return Hit{2.0, 0}; };
  NoiseSample sample(camera, model(GetParam()), 2.0 * pixel_direction(camera, 100, 50));
  const Scan scan = simulate_scan(camera, at_two_metres, model(GetParam()), 5);
  for (std::size_t i = 0; i < scan.size(); ++i) sample.add(scan.point(i));
  ASSERT_EQ(sample.count(), 20000);
  EXPECT_LT(sample.mean().cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT((sample.covariance() - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.03) << sample.covariance();
}

INSTANTIATE_TEST_SUITE_P(Models, RangeCameraNoise, testing::ValuesIn(every_model()), [](const auto& model) {
  std::string name = model.param.substr(0, model.param.find(':'));
  return name + "_" + std::to_string(model.index);
});

}  // namespace
}  // namespace patchlab
