#include "engine/region/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"
#include "engine/region/projector.h"

namespace patchlab {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();
constexpr int coarsest = 32;        // px, side of a cell
constexpr double most_gaps = 0.03;  // share of cells amid points that may be empty
constexpr int amid = 5;             // of the eight cells around, so many hold points
constexpr double steepest = 3.0;    // slope of a surface against the view that still is one
constexpr std::size_t points_a_chunk = 16384, rows_a_chunk = 32;
constexpr double hiding_reach = 1.5;  // cells, from a point to those that may hide it

// Least depths, row by row.
struct DepthGrid {
  int cell = 1;  // px
  int width = 0, height = 0;
  std::vector<float> depths;

  DepthGrid(int cell_px, int w, int h)
      : cell(cell_px),
        width(w),
        height(h),
        depths(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), nothing) {}

  float& at(int x, int y) { return depths[index(x, y)]; }
  float at(int x, int y) const {
    return x < 0 || y < 0 || x >= width || y >= height ? nothing : depths[index(x, y)];
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

DepthGrid coarser(const DepthGrid& fine) {
  DepthGrid grid(2 * fine.cell, (fine.width + 1) / 2, (fine.height + 1) / 2);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x)
      grid.at(x / 2, y / 2) = std::min(grid.at(x / 2, y / 2), fine.at(x, y));
  }
  return grid;
}

int occupied_around(const DepthGrid& grid, int x, int y) {
  int count = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) count += (dx != 0 || dy != 0) && grid.at(x + dx, y + dy) < nothing;
  }
  return count;
}

// Cells amid points, and the empty ones of them.
struct Gaps {
  std::size_t cells = 0, empty = 0;
};
Gaps gaps_in_row(const DepthGrid& grid, int y) {
  Gaps gaps;
  for (int x = 0; x < grid.width; ++x) {
    if (occupied_around(grid, x, y) < amid) continue;
    ++gaps.cells;
    gaps.empty += grid.at(x, y) == nothing;
  }
  return gaps;
}

bool closed(const DepthGrid& grid) {
  std::vector<Gaps> rows(static_cast<std::size_t>(grid.height));
  for_each_chunk(rows.size(), rows_a_chunk, [&](const Chunk& chunk) {
    for (std::size_t y = chunk.first; y < chunk.last; ++y) rows[y] = gaps_in_row(grid, static_cast<int>(y));
  });
  Gaps all;
  for (const Gaps& row : rows) {
    all.cells += row.cells;
    all.empty += row.empty;
  }
  return all.cells > 0 && static_cast<double>(all.empty) <= most_gaps * static_cast<double>(all.cells);
}

// The nearest in each cell and those beside it.
DepthGrid nearest_around(const DepthGrid& grid) {
  DepthGrid nearest = grid;
  for_each_chunk(static_cast<std::size_t>(grid.height), rows_a_chunk, [&](const Chunk& chunk) {
    for (int y = static_cast<int>(chunk.first); y < static_cast<int>(chunk.last); ++y)
      for (int x = 0; x < grid.width; ++x)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            nearest.at(x, y) = std::min(nearest.at(x, y), grid.at(x + dx, y + dy));
  });
  return nearest;
}

bool same(const ViewCamera& a, const ViewCamera& b) {
  return a.position == b.position && a.quaternion_xyzw == b.quaternion_xyzw && a.fov_y == b.fov_y &&
         a.near_plane == b.near_plane && a.far_plane == b.far_plane && a.perspective == b.perspective &&
         a.height == b.height && a.viewport == b.viewport;
}

}  // namespace

std::vector<std::uint8_t> visible_points(const Scan& scan, const ViewCamera& camera, double thickness) {
  const Projector project_point(camera);
  const int width = camera.viewport[0], height = camera.viewport[1];
  const auto in_view = [&](const Projected& p) {
    return in_depth(camera, p.depth) && p.x >= 0.0 && p.y >= 0.0 && p.x < width && p.y < height;
  };
  std::vector<std::uint8_t> seen(scan.size(), 0);
  std::vector<Projected> pixels(scan.size());
  DepthGrid grid(1, width, height);
  for_each_chunk(scan.size(), points_a_chunk, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      if (!scan.finite[i]) continue;
      pixels[i] = project_point(scan.point(i));
      seen[i] = in_view(pixels[i]);
    }
  });
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!seen[i]) continue;
    float& depth = grid.at(static_cast<int>(pixels[i].x), static_cast<int>(pixels[i].y));
    depth = std::min(depth, static_cast<float>(pixels[i].depth));
  }
  while (grid.cell < coarsest && !closed(grid)) grid = coarser(grid);
  const DepthGrid nearest = nearest_around(grid);
  for_each_chunk(scan.size(), points_a_chunk, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      if (!seen[i]) continue;
      const Projected& p = pixels[i];
      const double slant = steepest * hiding_reach * grid.cell * project_point.footprint(p.depth);
      const float before = nearest.at(static_cast<int>(p.x) / grid.cell, static_cast<int>(p.y) / grid.cell);
      seen[i] = p.depth - before <= slant + thickness;
    }
  });
  return seen;
}

std::shared_ptr<const std::vector<std::uint8_t>> VisibilityCache::get(const std::shared_ptr<const Scan>& scan,
                                                                      const ViewCamera& camera,
                                                                      double thickness) {
  const std::scoped_lock lock(mutex_);
  if (!seen_ || scan != scan_ || !same(camera, camera_) || thickness != thickness_) {
    seen_ = std::make_shared<const std::vector<std::uint8_t>>(visible_points(*scan, camera, thickness));
    scan_ = scan;
    camera_ = camera;
    thickness_ = thickness;
  }
  return seen_;
}

}  // namespace patchlab
