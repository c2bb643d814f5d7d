// What a fit receives: points with their covariances, and how the sensor saw them. It
// knows no sensor: a covariance that depends on where the surface is comes as a function.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace patchlab {

struct Observations {
  std::vector<Eigen::Vector3d> points;       // m, in the frame of the points
  std::vector<Eigen::Matrix3d> covariances;  // m^2, of each point as measured
  // The covariance of observation i re-evaluated at a foot point on the surface (m), where a sensor model
  // makes it; empty where the covariances are constants (method M11). Called from several threads at once.
  std::function<Eigen::Matrix3d(std::size_t i, const Eigen::Vector3d& foot)> covariance_at;

  // One a point, or empty: 1 where the point lies beside a depth edge. It counts for the outline, not for the
  // surface (method M13).
  std::vector<std::uint8_t> at_edge;

  // Position of the sensor: normals are turned towards it.
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  // One sensor position a point instead, for merged clouds; empty otherwise.
  std::vector<Eigen::Vector3d> viewpoints;
  // Optical axis of the camera at `viewpoint`, unit: points get pixel-footprint weights. Absent: weight 1
  // each.
  std::optional<Eigen::Vector3d> optical_axis;

  std::size_t size() const { return points.size(); }
};

}  // namespace patchlab
