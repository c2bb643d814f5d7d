#include "engine/region/observe.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "engine/pose/rotation.h"
#include "engine/region/pixel_edges.h"
#include "engine/sensor/point_covariances.h"

namespace patchlab {
namespace {

Eigen::Matrix3d full(const Covariance6& c) {
  return (Eigen::Matrix3d() << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]).finished();
}

// No eigenvalue below -1e-9 of the trace: exactly then does the shifted matrix have a Cholesky factor.
bool positive_semi_definite(const Eigen::Matrix3d& cov) {
  if (!cov.allFinite()) return false;
  if (cov.isZero(0.0)) return true;
  const Eigen::Matrix3d shifted = cov + 1e-9 * cov.trace() * Eigen::Matrix3d::Identity();
  return cov.trace() > 0.0 && shifted.llt().info() == Eigen::Success;
}

Viewpoint looking_at(const Eigen::Vector3d& position, const Eigen::Vector3d& point) {
  const Eigen::Quaterniond q(shortest_turn(Eigen::Vector3d::UnitZ(), point - position));
  return {position, {q.x(), q.y(), q.z(), q.w()}, true};
}

std::string name_of(const Scan& scan) { return scan.file.empty() ? "the scan" : scan.file; }

Result<Eigen::Matrix3d> stored_covariance(const Scan& scan, std::uint32_t id) {
  const Eigen::Matrix3d cov = full(scan.covariances[id]);
  if (positive_semi_definite(cov)) return cov;
  return Error{ErrorCode::unreadable, name_of(scan) + ": the covariance of point " + std::to_string(id) +
                                          " (counted from 0) is not " +
                                          (cov.allFinite() ? "positive semi-definite" : "finite") +
                                          "; correct it or name a sensor model with --noise."};
}

// Where a point's own is not finite, the scan's.
Eigen::Vector3d sensor_position(const Scan& scan, std::size_t id) {
  const bool is_own = !scan.viewpoints.empty() && scan.viewpoints[id].allFinite();
  return is_own ? (scan.origin + scan.viewpoints[id].cast<double>()).eval() : scan.viewpoint.position;
}

void use_one_sensor(const Scan& scan, const NoiseModel& model, Observations& observations) {
  const Eigen::Matrix3d R = rotation(scan.viewpoint);
  const Eigen::Vector3d position = scan.viewpoint.position;
  observations.covariance_at = [model, R, position](std::size_t, const Eigen::Vector3d& foot) {
    return covariance(model, R, position, foot);
  };
  observations.covariances = covariances(model, R, position, observations.points);
}

void use_own_sensors(const NoiseModel& model, Observations& observations) {
  std::vector<Viewpoint> sensors;
  observations.covariances.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    sensors.push_back(looking_at(observations.viewpoints[i], observations.points[i]));
    observations.covariances.push_back(covariance(model, sensors[i], observations.points[i]));
  }
  observations.covariance_at = [model, sensors = std::move(sensors)](std::size_t i,
                                                                     const Eigen::Vector3d& foot) {
    return covariance(model, sensors[i], foot);
  };
}

void use_sensor_model(const Scan& scan, const NoiseModel& model, Observations& observations) {
  if (observations.viewpoints.empty()) return use_one_sensor(scan, model, observations);
  use_own_sensors(model, observations);
}

std::vector<double> depth_sigmas(const Scan& scan, const Observations& observations) {
  const Eigen::Vector3d axis = rotation(scan.viewpoint).col(2);
  std::vector<double> sigmas;
  sigmas.reserve(observations.size());
  for (const Eigen::Matrix3d& cov : observations.covariances)
    sigmas.push_back(std::sqrt(axis.dot(cov * axis)));
  return sigmas;
}

}  // namespace

Viewpoint sensor_of(const Scan& scan, std::size_t id) {
  if (scan.viewpoints.empty()) return scan.viewpoint;
  return looking_at(sensor_position(scan, id), scan.point(id));
}

Result<Observations> observe(const Scan& scan, const NoiseModel& model, std::span<const std::uint32_t> ids,
                             std::vector<std::uint32_t>* kept) {
  if (model.from_file() && scan.covariances.empty()) {
    return Error{
        ErrorCode::usage,
        name_of(scan) + ": holds no covariances for the noise model from_file; name a sensor model."};
  }
  Observations observations;
  observations.points.reserve(ids.size());
  std::vector<std::uint32_t> used;
  for (const std::uint32_t id : ids) {
    if (!scan.finite[id]) continue;
    observations.points.push_back(scan.point(id));
    if (!scan.viewpoints.empty()) observations.viewpoints.push_back(sensor_position(scan, id));
    if (model.from_file()) {
      Result<Eigen::Matrix3d> cov = stored_covariance(scan, id);
      if (!cov) return cov.error();
      observations.covariances.push_back(*cov);
    }
    used.push_back(id);
  }
  if (!model.from_file()) {
    use_sensor_model(scan, model, observations);
    observations.at_edge = pixel_edges(scan, used, depth_sigmas(scan, observations));
  }
  observations.viewpoint = scan.viewpoint.position;
  const bool one_camera = scan.viewpoints.empty() && (scan.organized() || scan.format == "csv");
  if (one_camera) observations.optical_axis = rotation(scan.viewpoint).col(2);
  if (kept != nullptr) *kept = std::move(used);
  return observations;
}

}  // namespace patchlab
