// A simulated range camera: the one source of synthetic truth for tests, benchmarks, `patchlab simulate`, the
// sample scan and the pictures. It takes a ray -> hit function and knows no scene.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "engine/scan/scan.h"
#include "engine/sensor/noise_model.h"

namespace patchlab {

struct Camera {
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  double fx = 525.0, fy = 525.0, cx = 319.5, cy = 239.5;  // px
  Viewpoint pose;                                         // world_from_camera; z forward, x right, y down
  double depth_step = 0.0;  // m: measured depths are multiples of it, along the ray; 0: they are not
  double missing = 0.0;     // share of the pixels that give no return though something is there
};

// The nearest surface along origin + s direction (world frame, s > 0): s and which object it is.
struct Hit {
  double s;
  std::uint32_t object;
};
using CastRay =
    std::function<std::optional<Hit>(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)>;

// The direction of a pixel in the sensor frame, z = 1: a hit at s lies at depth s.
Eigen::Vector3d pixel_direction(const Camera& camera, std::uint32_t column, std::uint32_t row);

// An organised scan, row by row, in the world frame, viewpoint stated; pixels without a return are NaN.
// Labels: object index + 1, 0 where nothing is. Noise is drawn from the model's covariance at the true point
// (precondition: the model is not from_file); the draw of a pixel depends on the seed and the pixel alone,
// not on what else is seen. Colours are left empty.
Scan simulate_scan(const Camera& camera, const CastRay& cast, const NoiseModel& noise, std::uint64_t seed);

}  // namespace patchlab
