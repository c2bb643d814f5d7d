// Points of three float32 as they lie in a file, taken over in one pass that looks at each.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/io/columns.h"

namespace patchlab {

struct FloatSurvey {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low = {infinity, infinity,
                              infinity};  // of the finite points; low > high: there are none
  std::array<float, 3> high = {-infinity, -infinity, -infinity};
  std::size_t finite = 0;   // points
  std::size_t strange = 0;  // of these: with a coordinate beyond 1e7, or below 1e-30 and not 0
};

// Writes `points` positions, NaN where one of the three is not finite, and sets `finite` to 0 there, which is
// 1 elsewhere before. Precondition: float32 columns in this machine's byte order.
FloatSurvey take_floats(const std::array<const Column*, 3>& xyz, std::size_t points,
                        Eigen::Vector3f* positions, std::uint8_t* finite);
// The same for any processor and any places of the columns: what the other is held to.
FloatSurvey take_floats_plain(const std::array<const Column*, 3>& xyz, std::size_t points,
                              Eigen::Vector3f* positions, std::uint8_t* finite);

}  // namespace patchlab
