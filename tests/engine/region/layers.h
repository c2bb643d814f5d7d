// Made scans for tests of regions: two parallel sheets, a bent one, each with its points known by index.
#pragma once

#include <cmath>

#include "engine/base/random.h"
#include "engine/scan/scan.h"

namespace patchlab {

inline constexpr int sheet_side = 41;  // points
inline constexpr int sheet_points = sheet_side * sheet_side;
inline constexpr double sheet_step = 0.005;  // m

inline void add_point(Scan& scan, const Eigen::Vector3d& point) {
  scan.positions.push_back((point - scan.origin).cast<float>());
  scan.finite.push_back(1);
  ++scan.finite_count;
  scan.width = static_cast<std::uint32_t>(scan.size());
}

// A square sheet about (0, 0, z), row by row along x; `bend` (rad) folds its right half up about the y axis.
inline void add_sheet(Scan& scan, double z, double bend = 0.0) {
  const int half = sheet_side / 2;
  for (int row = -half; row <= half; ++row) {
    for (int column = -half; column <= half; ++column) {
      const double along = column * sheet_step;
      const bool folded = along > 0.0;
      add_point(scan, {folded ? along * std::cos(bend) : along, row * sheet_step,
                       z + (folded ? along * std::sin(bend) : 0.0)});
    }
  }
}

}  // namespace patchlab
