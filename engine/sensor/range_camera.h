// A simulated range camera: the one source of synthetic truth for tests, benchmarks, `patchlab simulate`, the sample
// scan and the pictures. It takes a ray -> hit function and knows no scene.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "engine/base/random.h"
#include "engine/pose/pose.h"
#include "engine/scan/scan.h"
#include "engine/sensor/noise_model.h"

namespace patchlab {

struct Camera {
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  double fx = 525.0, fy = 525.0, cx = 319.5, cy = 239.5;  // px
  Viewpoint pose;                                         // world_from_camera; z forward, x right, y down
};

// The nearest surface along origin + s direction (world frame, s > 0): s and which object it is.
struct Hit {
  double s;
  std::uint32_t object;
};
using CastRay = std::function<std::optional<Hit>(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)>;

// An organised scan, row by row, in the world frame, viewpoint stated; pixels without a return are NaN. Labels: object
// index + 1, 0 where nothing is. Noise is drawn from the model's covariance at the true point. colours are left empty.
Scan simulate_scan(const Camera& camera, const CastRay& cast, const NoiseModel& noise, std::uint64_t seed);

}  // namespace patchlab
