#include "engine/region/lasso.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <numeric>

#include "engine/base/large_pages.h"
#include "engine/base/parallel.h"
#include "engine/region/lasso_candidates.h"
#include "engine/region/polygon_mask.h"
#include "engine/region/projector.h"

namespace patchlab {
namespace {

constexpr std::size_t block = LassoCandidates::capacity;  // points at a time
constexpr std::size_t points_a_part = 64 * block;         // that one thread looks at

// Leaves out the open candidates that are not inside.
template <class IsInside>
void decide(LassoCandidates& found, const IsInside& is_inside) {
  std::size_t kept = found.open_count > 0 ? found.open[0] : found.count;
  for (std::size_t i = kept, next = 0; i < found.count; ++i) {
    const bool is_open = next < found.open_count && found.open[next] == i;
    next += is_open ? 1 : 0;
    if (!is_open || is_inside(found.points[i])) found.points[kept++] = found.points[i];
  }
  found.count = kept;
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
  // Each chunk has its own place: memory that nothing is written to costs nothing.
  const auto places = std::make_unique_for_overwrite<std::uint32_t[]>(scan.size());
  std::vector<std::size_t> counts(chunk_count(scan.size(), points_a_part));
  for_each_chunk(scan.size(), points_a_part, [&](const Chunk& chunk) {
    LassoCandidates found;
    std::uint32_t* const begin = places.get() + chunk.first;
    std::uint32_t* end = begin;
    for (std::size_t first = chunk.first; first < chunk.last; first += block) {
      const std::size_t count = std::min(block, chunk.last - first);
      find_candidates(cells, grid, scan.positions[first].data(), count, static_cast<std::uint32_t>(first),
                      found);
      decide(found, is_inside);
      end = std::copy_n(found.points.begin(), found.count, end);
    }
    counts[chunk.number] = static_cast<std::size_t>(end - begin);
  });
  reserve_large(selected, std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  for (std::size_t part = 0; part < counts.size(); ++part) {
    const std::uint32_t* const begin = places.get() + part * points_a_part;
    selected.insert(selected.end(), begin, begin + counts[part]);
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
