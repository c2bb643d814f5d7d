// How bright each point of a scan is drawn, so that its shape can be seen: lit from the sensor where the
// points have neighbours to make normals of, and darker with distance.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab::viewer {

// 0..255 a point; 0 where it is not finite. Quick for organised scans: normals of planes through the pixels
// around where a pinhole camera saw them, else by differences on the grid. Others get normals from their
// neighbours up to `normals_limit` points, and distance alone above it.
std::vector<std::uint8_t> point_shades(const Scan& scan, std::size_t normals_limit = 150'000);

}  // namespace patchlab::viewer
