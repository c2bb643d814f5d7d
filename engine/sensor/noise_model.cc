#include "engine/sensor/noise_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/sensor/roughness.h"

namespace patchlab {
namespace {

constexpr double roughness_where_unknown = 0.001;  // m
constexpr double smallest_estimate = 1e-6;         // m: also for points that lie exactly on their surface

NoiseModel assumed_model(std::string specification) {
  NoiseModel model = *noise_model(specification);
  model.assumed = true;
  return model;
}

// Three digits: enough for an estimate, and the model is exactly what its specification says.
std::string estimated_specification(double sigma) {
  char digits[32];
  const auto [end, error] =
      std::to_chars(digits, digits + sizeof digits, sigma, std::chars_format::general, 3);
  return "estimated:" + std::string(digits, end);
}

Eigen::Matrix3d noise_covariance(const StereoNoise& noise, const Eigen::Vector3d& p) {
  // Sigma = J diag(pointing^2, pointing^2, disparity^2) J' of Section IV.B, with x/z = u/f and y/z = v/f put
  // in: the third column of J is -z/(f baseline) p, the ray itself, and nothing is divided by z.
  const double lateral = p.z() * noise.pointing / noise.f;
  const double along_ray = p.z() * noise.disparity / (noise.f * noise.baseline);
  Eigen::Matrix3d cov = (along_ray * along_ray) * p * p.transpose();
  cov.diagonal().head<2>().array() += lateral * lateral;
  return cov;
}

Eigen::Matrix3d noise_covariance(const DepthNoise& noise, const Eigen::Vector3d& p) {
  const double z = std::abs(p.z()), beyond = z - noise.nearest;
  const double depth = noise.constant + noise.linear * z + noise.quadratic * beyond * beyond +
                       noise.power_1_5 * z * std::sqrt(z);
  const double lateral = noise.lateral + noise.lateral_z * z;
  const Eigen::Vector3d ray = z > 0.0 ? Eigen::Vector3d(p / z) : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d cov = (depth * depth) * ray * ray.transpose();
  cov.diagonal().head<2>().array() += lateral * lateral;
  return cov;
}

Eigen::Matrix3d noise_covariance(const LidarNoise& noise, const Eigen::Vector3d& p) {
  // Sigma = range^2 w w' + r^2 angle^2 (I - w w') with r^2 (I - w w') = r^2 I - p p': nothing is divided by r
  // but in w.
  const double r2 = p.squaredNorm();
  const Eigen::Vector3d w = r2 > 0.0 ? Eigen::Vector3d(p / std::sqrt(r2)) : Eigen::Vector3d::UnitZ();
  const double along = noise.range * noise.range, across = r2 * noise.angle * noise.angle;
  return (along - across) * w * w.transpose() + across * Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d noise_covariance(const IsotropicNoise& noise, const Eigen::Vector3d&) {
  return noise.sigma * noise.sigma * Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d noise_covariance(const NoiseFromFile&, const Eigen::Vector3d&) {
  return Eigen::Matrix3d::Zero();
}

}  // namespace

NoiseModel default_noise_model(const Scan& scan) {
  if (!scan.covariances.empty()) return {"from_file", NoiseFromFile{}, false};
  if (scan.organized()) return assumed_model("kinect1");
  const double sigma = local_roughness(scan).value_or(roughness_where_unknown);
  return assumed_model(estimated_specification(std::max(sigma, smallest_estimate)));
}

Eigen::Matrix3d covariance(const NoiseModel& model, const Viewpoint& viewpoint,
                           const Eigen::Vector3d& point) {
  return covariance(model, rotation(viewpoint), viewpoint.position, point);
}

Eigen::Matrix3d covariance(const NoiseModel& model, const Eigen::Matrix3d& world_from_sensor,
                           const Eigen::Vector3d& sensor_position, const Eigen::Vector3d& point) {
  const Eigen::Vector3d point_sensor = world_from_sensor.transpose() * (point - sensor_position);
  const Eigen::Matrix3d cov =
      world_from_sensor * covariance_in_sensor(model, point_sensor) * world_from_sensor.transpose();
  return 0.5 * (cov + cov.transpose());
}

Eigen::Matrix3d covariance_in_sensor(const NoiseModel& model, const Eigen::Vector3d& point_sensor) {
  return std::visit([&](const auto& noise) { return noise_covariance(noise, point_sensor); }, model.kind);
}

}  // namespace patchlab
