// Regions made of regions, and of a point: by who is whose neighbour. Ids are ascending throughout; the
// result depends on the scan and the ids alone.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/scan/scan.h"

namespace patchlab {

using PointIds = std::vector<std::uint32_t>;

// The finite points that are not in the region.
PointIds invert(const Scan& scan, const PointIds& ids);
// With a ring of neighbours (the nearest eight of each point), or without the ring of those that have a
// neighbour outside; `steps` times.
PointIds grow(const Scan& scan, const PointIds& ids, int steps);
PointIds shrink(const Scan& scan, const PointIds& ids, int steps);

// How far a surface is followed from point to point.
struct FloodLimits {
  double step = 0.12;                     // rad, between the normals of neighbours
  std::optional<double> from_seed = 1.0;  // rad, between any normal and that of the seed
  double jump = 3.0;  // a neighbour may be so many times further away than its fellows are from each other
};

// The smooth surface that the finite point nearest to `seed` (m, frame of the points) lies on.
// cancelled error.
Result<PointIds> flood(const Scan& scan, const Eigen::Vector3d& seed, const FloodLimits& limits,
                       const Progress& progress = {});
// The same from all points of a region, without a limit against one seed: everything smoothly connected.
Result<PointIds> linked(const Scan& scan, const PointIds& ids, const Progress& progress = {});

}  // namespace patchlab
