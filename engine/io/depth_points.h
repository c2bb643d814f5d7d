// The points of a depth image. For x86-64 and, chosen at run time, for AVX2; the same bytes from either.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/io/read_scan.h"

namespace patchlab {

struct DepthPixels {
  std::span<const std::uint16_t> samples;  // row by row; 0: no depth
  std::size_t width;                       // px
  Intrinsics camera;
  double scale;  // raw units a metre
};

// x = (u - cx) z / fx, y = (v - cy) z / fy: z lies along the optical axis (REP 118), not along the ray.
// Writes one position a pixel, NaN where it has no depth, and 1 in `finite` where all three are finite, else
// 0. Returns how many are.
std::size_t unproject(const DepthPixels& pixels, Eigen::Vector3f* positions, std::uint8_t* finite);
// The same for any processor: what the other is held to.
std::size_t unproject_plain(const DepthPixels& pixels, Eigen::Vector3f* positions, std::uint8_t* finite);

}  // namespace patchlab
