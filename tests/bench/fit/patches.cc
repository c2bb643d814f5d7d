#include "tests/bench/fit/patches.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "engine/base/random.h"
#include "engine/patch/surface.h"
#include "engine/pose/rotation.h"
#include "engine/sensor/noise_model.h"

namespace patchlab::bench {
namespace {

const Vector3d kappa_of_all(-8.0, -3.0, 0.0);  // 1/m
constexpr double radius = 0.1;                 // m

Observations one_patch(Random& random, const NoiseModel& kinect, std::size_t points) {
  const Vector3d c(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.9, 1.1));
  const Vector3d z = (-c.normalized() + 0.4 * random.unit3()).normalized();
  const Matrix3d R =
      shortest_turn(Vector3d::UnitZ(), z) * exp_map({0.0, 0.0, random.uniform(0.0, 2.0 * std::numbers::pi)});
  Observations patch;
  patch.optical_axis = Vector3d::UnitZ();
  while (patch.size() < points) {
    const Vector2d u(random.uniform(-radius, radius), random.uniform(-radius, radius));
    if (u.norm() > radius) continue;
    const Vector3d q = c + R * surface_point(u, kappa_of_all);
    const Matrix3d cov = covariance_in_sensor(kinect, q);
    patch.points.push_back(q + cov.llt().matrixL() * random.normal3());
    patch.covariances.push_back(cov);
  }
  return patch;
}

}  // namespace

std::vector<Observations> patches(std::size_t points, int draws) {
  const NoiseModel kinect = *noise_model("stereo:f=525,baseline=0.075,pointing=0.35,disparity=0.17");
  Random random(8);
  std::vector<Observations> all;
  for (int i = 0; i < draws; ++i) all.push_back(one_patch(random, kinect, points));
  return all;
}

std::vector<Samples> samples_of(const std::vector<Observations>& all) {
  std::vector<Samples> samples;
  for (const Observations& observations : all) samples.push_back(*make_samples(observations, 10));
  return samples;
}

}  // namespace patchlab::bench
