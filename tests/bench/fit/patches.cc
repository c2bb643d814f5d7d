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

struct Shape {
  Vector3d kappa;  // 1/m
  double radius;   // m
};

NoiseModel kinect() { return *noise_model("stereo:f=525,baseline=0.075,pointing=0.35,disparity=0.17"); }

Observations one_patch(Random& random, const NoiseModel& noise, const Shape& shape, std::size_t points) {
  const Vector3d c(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.9, 1.1));
  const Vector3d z = (-c.normalized() + 0.4 * random.unit3()).normalized();
  const Matrix3d R =
      shortest_turn(Vector3d::UnitZ(), z) * exp_map({0.0, 0.0, random.uniform(0.0, 2.0 * std::numbers::pi)});
  Observations patch;
  patch.optical_axis = Vector3d::UnitZ();
  while (patch.size() < points) {
    const Vector2d u(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    if (u.norm() > 1.0) continue;
    const Vector3d q = c + R * surface_point(shape.radius * u, shape.kappa);
    const Matrix3d cov = covariance_in_sensor(noise, q);
    patch.points.push_back(q + cov.llt().matrixL() * random.normal3());
    patch.covariances.push_back(cov);
  }
  return patch;
}

}  // namespace

std::vector<Observations> patches(std::size_t points, int draws) {
  const NoiseModel noise = kinect();
  Random random(8);
  std::vector<Observations> all;
  for (int i = 0; i < draws; ++i) all.push_back(one_patch(random, noise, {{-8.0, -3.0, 0.0}, 0.1}, points));
  return all;
}

std::vector<Observations> mixed_patches(std::size_t points) {
  constexpr double curvatures[8][2] = {{-8.0, -3.0},  {-10.0, -9.0}, {-5.0, -4.0}, {-1.0, -0.5},
                                       {-10.0, -0.3}, {-6.0, 4.0},   {7.0, 2.0},   {-3.0, 0.5}};
  constexpr int draws = 3;
  const NoiseModel noise = kinect();
  Random random(9);
  std::vector<Observations> all;
  for (const auto& [k_x, k_y] : curvatures) {
    for (const double radius : {0.06, 0.08, 0.1}) {
      for (int i = 0; i < draws; ++i)
        all.push_back(one_patch(random, noise, {{k_x, k_y, 0.0}, radius}, points));
    }
  }
  return all;
}

std::vector<Samples> samples_of(const std::vector<Observations>& all) {
  std::vector<Samples> samples;
  for (const Observations& observations : all) samples.push_back(*make_samples(observations, 10));
  return samples;
}

}  // namespace patchlab::bench
