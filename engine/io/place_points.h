// Where the points of a scan lie: floats about an origin that loses nothing.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/io/columns.h"
#include "engine/io/scan_from_columns.h"
#include "engine/scan/scan.h"

namespace patchlab {

using Points = std::vector<Eigen::Vector3d>;  // coordinates in the frame of the file, m

// Fills origin, positions, finite and finite_count. Says where no point is finite, and asks for the unit
// where the points span more than a scan of metres does.
void place_points(Scan& scan, const Points& points, OriginRule rule);
// The same in one pass over three columns of float32 in this machine's byte order; false, and the positions
// not filled, where most coordinates are beyond 1e7 or below 1e-30.
bool place_floats(Scan& scan, const std::array<const Column*, 3>& xyz, std::size_t points, OriginRule rule);

}  // namespace patchlab
