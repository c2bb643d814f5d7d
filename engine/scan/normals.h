// Surface normals of a scan, by PCL.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab {

// One unit normal a point, of the plane through its k nearest finite points (k >= 3), turned towards the
// sensor: the point's own sensor position where the scan has one, the scan's viewpoint otherwise. NaN where
// the point is not finite, and everywhere when fewer than three points are. Where the neighbours lie on one
// line it is any perpendicular.
std::vector<Eigen::Vector3f> estimate_normals(const Scan& scan, int k = 16);

}  // namespace patchlab
