// Does a circular cylinder's fit reach its minimum from any in-plane start? The plane of step 1 knows nothing
// of the axis: here its x axis is turned away from the true one by a stated angle.
#pragma once

#include <vector>

#include "tests/support/battery.h"

namespace patchlab::calibration {

struct StartCell {
  double degrees;  // between the start's x axis and the true axis, in the plane of step 1
  int trials = 0;
  int calibrated = 0, paper = 0;  // fits that ended at the true axis with the right sign of curvature
};

// Angles from 0 to 90 degrees.
std::vector<StartCell> cylinder_starts(const test::BatteryOptions& options);

}  // namespace patchlab::calibration
