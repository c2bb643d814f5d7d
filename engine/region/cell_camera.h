// The camera of a view in the cells of a polygon's grid, in float32: what the lasso puts millions of points
// through.
#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/region/lasso.h"
#include "engine/region/polygon_mask.h"

namespace patchlab {

// A camera and a grid made ready: with q = (x, y, z, 1) of a point about the scan's origin, its column is
// column.q / w and its row is row.q / w, in cells; w is depth.q (perspective) or 1 (orthographic).
struct CellCamera {
  std::array<float, 4> column, row, depth;  // depth in metre
  float seen_from, seen_to;  // m: a point out of these depths is not between the camera's planes
  float sure_from, sure_to;  // m: between these depths rounding does not move a point by a cell's margin
  bool perspective;
};

CellCamera cell_camera(const ViewCamera& camera, const Eigen::Vector3d& origin,
                       const PolygonMask::Grid& grid);

}  // namespace patchlab
