#include "engine/region/lasso.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/region/cells_of_points.h"
#include "engine/region/polygon_mask.h"
#include "engine/region/projector.h"

namespace patchlab {
namespace {

constexpr std::size_t block = 1024;  // points at a time

// Of a block of points: those whose cell says inside, and those it leaves open that are.
template <class IsInside>
void add_block(const Scan& scan, const CellCamera& camera, const PolygonMask::Grid& grid, std::size_t first,
               const IsInside& is_inside, std::vector<std::uint32_t>& selected) {
  const std::size_t count = std::min(block, scan.size() - first);
  std::array<std::int32_t, block> cells;
  std::array<std::uint32_t, block> open;
  cells_of_points(camera, scan.positions[first].data(), count, cells.data());
  const std::size_t found = not_outside(grid, cells.data(), count, open.data());
  for (std::size_t k = 0; k < found; ++k) {
    const std::uint32_t i = open[k], id = static_cast<std::uint32_t>(first) + i;
    if (grid.cells[cells[i]] == PolygonMask::inside || is_inside(id)) selected.push_back(id);
  }
}

}  // namespace

Projected project(const ViewCamera& camera, const Eigen::Vector3d& point) { return Projector(camera)(point); }

bool inside_polygon(const std::vector<Eigen::Vector2d>& contour, double x, double y) {
  return inside_polygon(polygon_edges(contour), x, y);
}

std::vector<std::uint32_t> select_lasso(const Scan& scan, const ViewCamera& camera,
                                        const std::vector<Eigen::Vector2d>& contour) {
  std::vector<std::uint32_t> selected;
  if (contour.size() < 3) return selected;
  const PolygonMask mask(contour);
  const Projector project_point(camera);
  const auto is_inside = [&](std::uint32_t id) {
    if (!scan.finite[id]) return false;
    const Projected pixel = project_point(scan.point(id));
    return in_depth(camera, pixel.depth) && mask.contains(pixel.x, pixel.y);
  };
  const PolygonMask::Grid grid = mask.grid();
  if (grid.rows == 0) {
    for (std::uint32_t id = 0; id < scan.size(); ++id) {
      if (is_inside(id)) selected.push_back(id);
    }
    return selected;
  }
  const CellCamera cells = cell_camera(camera, scan.origin, grid);
  for (std::size_t first = 0; first < scan.size(); first += block) {
    add_block(scan, cells, grid, first, is_inside, selected);
  }
  return selected;
}

std::vector<std::uint32_t> combine(const std::vector<std::uint32_t>& before,
                                   const std::vector<std::uint32_t>& selected, SelectMode mode) {
  std::vector<std::uint32_t> after;
  const auto out = std::back_inserter(after);
  switch (mode) {
    case SelectMode::set:
      return selected;
    case SelectMode::add:
      std::set_union(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
    case SelectMode::subtract:
      std::set_difference(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
    case SelectMode::intersect:
      std::set_intersection(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
  }
  return after;
}

}  // namespace patchlab
