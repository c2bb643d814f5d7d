// What of a scan deserves a second look: points that are there twice, and points far from all others.
#pragma once

#include <cstddef>

#include "engine/scan/scan.h"

namespace patchlab {

struct Survey {
  std::size_t duplicates = 0;    // finite points that lie exactly where an earlier one does
  std::size_t far_outliers = 0;  // finite points farther from the middle than far_factor times most points
};

// The middle is the median of each coordinate, most points are nine tenths of them.
inline constexpr double far_factor = 10.0;

Survey survey(const Scan& scan);

}  // namespace patchlab
