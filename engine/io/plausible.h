// Does what was read look like coordinates at all?
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/columns.h"

namespace patchlab {

enum class Plausibility {
  plausible,
  doubtful,     // more than half of the points are huge or denormal
  other_order,  // they make sense in the other byte order only
  other_type,   // they make sense as floating point numbers declared as integers, or the other way round
};

// `points` are the values of the three columns.
Plausibility judge_coordinates(const std::array<Column, 3>& xyz, const std::vector<Eigen::Vector3d>& points);

}  // namespace patchlab
