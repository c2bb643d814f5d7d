// The points of a region as observations for a fit: the sensor's covariances, rays and viewpoint put beside
// them.
#pragma once

#include <cstdint>
#include <span>

#include "engine/base/result.h"
#include "engine/fit/observation.h"
#include "engine/scan/scan.h"
#include "engine/sensor/noise_model.h"

namespace patchlab {

// The sensor that saw a point: the scan's, or of a scan of many sensors the point's own, known by its
// position alone and taken to look along the ray.
Viewpoint sensor_of(const Scan& scan, std::size_t id);

// Non-finite points are left out; `kept` (optional) receives the ids that remain, in the order of the
// observations. unreadable error where a covariance of the file is not symmetric positive semi-definite
// (names the point). Under a sensor model, points at a depth edge of an organised scan
// (engine/region/pixel_edges.h) are marked: they would widen curved objects, whose silhouettes count most.
// The optical axis is the viewpoint's z for organised scans and for point tables; absent otherwise.
// `observations` may outlive neither `model` nor `scan`: both are captured by value where they are needed.
Result<Observations> observe(const Scan& scan, const NoiseModel& model, std::span<const std::uint32_t> ids,
                             std::vector<std::uint32_t>* kept = nullptr);

}  // namespace patchlab
