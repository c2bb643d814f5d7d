#include "engine/sensor/point_covariances.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "engine/base/random.h"

namespace patchlab {
namespace {

constexpr const char* kModels[] = {"kinect1",      "khoshelham",     "nguyen", "kinect2",
                                   "azure_kinect", "realsense_d435", "lidar",  "isotropic:0.002"};

struct Sensor {
  Eigen::Matrix3d R = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  Eigen::Vector3d position = {3.0, -1.0, 2.0};
};

std::vector<Eigen::Vector3d> points_before(const Sensor& sensor, std::size_t count) {
  Random random(41);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(sensor.position + sensor.R * (random.normal3() + Eigen::Vector3d(0, 0, 4)));
  return points;
}

TEST(PointCovariances, AreThoseOfTheModelAndExactlySymmetric) {
  const Sensor sensor;
  for (const char* const name : kModels) {
    const NoiseModel model = *noise_model(name);
    for (const std::size_t count : {0u, 1u, 2u, 3u, 200u}) {
      std::vector<Eigen::Vector3d> points = points_before(sensor, count);
      if (count == 200) points[77] = sensor.position;  // the sensor itself
      const std::vector<Eigen::Matrix3d> found = covariances(model, sensor.R, sensor.position, points);
      ASSERT_EQ(found.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Matrix3d expected = covariance(model, sensor.R, sensor.position, points[i]);
        EXPECT_TRUE(found[i].isApprox(expected, 1e-12)) << name << " " << i << "\n" << found[i];
        EXPECT_EQ(found[i], found[i].transpose()) << name;
      }
    }
  }
}

TEST(PointCovariances, AreTheSameBytesFromEveryKernel) {
  const Sensor sensor;
  const std::vector<Eigen::Vector3d> points = points_before(sensor, 1001);
  for (const char* const name : kModels) {
    const NoiseModel model = *noise_model(name);
    EXPECT_EQ(covariances(model, sensor.R, sensor.position, points),
              covariances_plain(model, sensor.R, sensor.position, points))
        << name;
  }
}

}  // namespace
}  // namespace patchlab
