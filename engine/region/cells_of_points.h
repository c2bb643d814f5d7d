// The hot loop of the lasso: which cell of a polygon's grid each of many points is seen in. In float32, with
// its rounding bounded point by point; where that could tell cells apart wrongly it says `unsure`. For
// x86-64 and, chosen at run time, for AVX2 with FMA.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/region/lasso.h"
#include "engine/region/polygon_mask.h"

namespace patchlab {

// A camera and a grid made ready: with q = (x, y, z, 1) of a point about the scan's origin, its column is
// column.q / w and its row is row.q / w, in cells; w is depth.q (perspective) or 1 (orthographic).
struct CellCamera {
  std::array<float, 4> column, row, depth;  // depth in metre
  std::array<float, 4> rounding;  // times (|x|, |y|, |z|, 1): bounds the rounding of column.q, row.q in cells
                                  // and of depth.q in metre, each by far
  float near_plane, far_plane;    // m
  std::int32_t columns, rows;     // of the grid
  bool perspective;
};

CellCamera cell_camera(const ViewCamera& camera, const Eigen::Vector3d& origin,
                       const PolygonMask::Grid& grid);

// cells[i]: row by row, the cell of the point xyz[3 i], xyz[3 i + 1], xyz[3 i + 2]; columns * rows where it
// is surely not seen in the grid (not between the planes, beside it, not a number); one more where that is
// unsure. A cell that is given is its cell, or lies within PolygonMask::margin of it.
void cells_of_points(const CellCamera& camera, const float* xyz, std::size_t count, std::int32_t* cells);

// Writes the indices i of those of `count` cells that are not outside, ascending, and returns how many.
std::size_t not_outside(const PolygonMask::Grid& grid, const std::int32_t* cells, std::size_t count,
                        std::uint32_t* indices);

// The same for any processor: what the others are held to.
void cells_of_points_plain(const CellCamera& camera, const float* xyz, std::size_t count,
                           std::int32_t* cells);
std::size_t not_outside_plain(const PolygonMask::Grid& grid, const std::int32_t* cells, std::size_t count,
                              std::uint32_t* indices);

}  // namespace patchlab
