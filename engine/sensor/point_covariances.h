// The covariances of many points seen by one sensor: covariance() of noise_model.h without its products of
// matrices. For x86-64 and, chosen at run time, for AVX2; the same bytes from either.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/sensor/noise_model.h"

namespace patchlab {

// One a point, m^2, in the frame of the points; equal to covariance() but for rounding, and exactly
// symmetric. Precondition: the model is not from_file.
std::vector<Eigen::Matrix3d> covariances(const NoiseModel& model, const Eigen::Matrix3d& world_from_sensor,
                                         const Eigen::Vector3d& sensor_position,
                                         std::span<const Eigen::Vector3d> points);
// The same for any processor: what the other is held to.
std::vector<Eigen::Matrix3d> covariances_plain(const NoiseModel& model,
                                               const Eigen::Matrix3d& world_from_sensor,
                                               const Eigen::Vector3d& sensor_position,
                                               std::span<const Eigen::Vector3d> points);

}  // namespace patchlab
