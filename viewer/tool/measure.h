// The distance between two points of the scans, with the standard deviation that the noise of the two gives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/project/document.h"

namespace patchlab::viewer {

struct MeasuredPoint {
  std::string scan;          // id
  Eigen::Vector3d position;  // m
  Eigen::Matrix3d cov;       // m^2, of the point
};

struct MeasuredDistance {
  double metres = 0.0;
  double sigma = 0.0;  // m, to first order; the errors of two points count as independent
};
MeasuredDistance distance(const MeasuredPoint& one, const MeasuredPoint& other);

}  // namespace patchlab::viewer
