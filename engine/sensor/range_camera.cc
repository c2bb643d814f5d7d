#include "engine/sensor/range_camera.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "engine/base/random.h"

namespace patchlab {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The seed of one row's random numbers, by the finalizer of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t row_seed(std::uint64_t seed, std::uint32_t row) {
  std::uint64_t mixed = seed + 0x9e3779b97f4a7c15ULL * (std::uint64_t{row} + 1);
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ULL;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebULL;
  return mixed ^ (mixed >> 31);
}

// A sample of N(0, covariance) from one of N(0, I); pivoted, so a covariance without full rank is fine.
Vector3d coloured(const Matrix3d& covariance, const Vector3d& white) {
  const Eigen::LDLT<Matrix3d> factors(covariance);
  const Vector3d scaled = factors.vectorD().cwiseMax(0.0).cwiseSqrt().cwiseProduct(white);
  return factors.transpositionsP().transpose() * (factors.matrixL() * scaled);
}

// As a camera writes it whose depths are whole numbers of a step: moved along the ray.
Vector3d quantised(const Vector3d& point_sensor, double step) {
  if (step <= 0.0) return point_sensor;
  return point_sensor * (step * std::round(point_sensor.z() / step) / point_sensor.z());
}

Scan empty_scan(const Camera& camera) {
  Scan scan;
  scan.fields = {{"x", "float32", 1}, {"y", "float32", 1}, {"z", "float32", 1}, {"label", "uint32", 1}};
  scan.width = camera.width;
  scan.height = camera.height;
  scan.viewpoint = camera.pose;
  scan.viewpoint.stated = true;
  scan.intrinsics = {camera.fx, camera.fy, camera.cx, camera.cy};
  const std::size_t pixels = std::size_t{camera.width} * camera.height;
  scan.positions.assign(pixels, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  scan.finite.assign(pixels, 0);
  scan.labels.assign(pixels, 0);
  return scan;
}

}  // namespace

Vector3d pixel_direction(const Camera& camera, std::uint32_t column, std::uint32_t row) {
  return {(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0};
}

Scan simulate_scan(const Camera& camera, const CastRay& cast, const NoiseModel& noise, std::uint64_t seed) {
  const Matrix3d R_world_sensor = rotation(camera.pose);
  const Vector3d& origin_world = camera.pose.position;
  Scan scan = empty_scan(camera);
  std::size_t pixel = 0;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    Random random(row_seed(seed, row)), lost(row_seed(~seed, row));
    for (std::uint32_t column = 0; column < camera.width; ++column, ++pixel) {
      const Vector3d white = random.normal3();
      const bool missing = lost.uniform() < camera.missing;
      const Vector3d direction_sensor = pixel_direction(camera, column, row);
      const std::optional<Hit> hit = cast(origin_world, R_world_sensor * direction_sensor);
      if (!hit || missing) continue;
      const Vector3d true_sensor = hit->s * direction_sensor;
      const Vector3d measured_sensor = quantised(
          true_sensor + coloured(covariance_in_sensor(noise, true_sensor), white), camera.depth_step);
      scan.positions[pixel] = (R_world_sensor * measured_sensor + origin_world).cast<float>();
      scan.finite[pixel] = 1;
      scan.labels[pixel] = hit->object + 1;
      ++scan.finite_count;
    }
  }
  return scan;
}

}  // namespace patchlab
