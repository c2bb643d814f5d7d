// The hot loop of the lasso: which of many points may lie in a polygon's grid of cells. In float32, with its
// rounding bounded point by point; what that could decide wrongly is left open. For x86-64 and, chosen at run
// time, for AVX2 with FMA.
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
  bool perspective;
};

CellCamera cell_camera(const ViewCamera& camera, const Eigen::Vector3d& origin,
                       const PolygonMask::Grid& grid);

// The candidates among up to `capacity` points, ascending.
struct LassoCandidates {
  static constexpr std::size_t capacity = 1024;
  std::array<std::uint32_t, capacity + 8>
      points;  // numbers of those that are not surely outside; room for a vector
  std::array<std::uint32_t, capacity> open;  // which of them only the exact test can tell
  std::size_t count = 0, open_count = 0;
};

// Of `count` points x y z, the first of number `first`. Those not left open are in the polygon. Precondition:
// the grid has rows, count is at most LassoCandidates::capacity.
void find_candidates(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                     std::size_t count, std::uint32_t first, LassoCandidates& found);
// The same for any processor: what the other is held to.
void find_candidates_plain(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                           std::size_t count, std::uint32_t first, LassoCandidates& found);

}  // namespace patchlab
