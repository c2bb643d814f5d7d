#include "engine/region/lasso.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <memory>
#include <numeric>
#include <span>

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
void decide(LassoCandidates& found, std::size_t first, const IsInside& is_inside) {
  for (std::size_t i = 0; i < found.open.size(); ++i) {
    for (std::uint64_t open = found.open[i]; open != 0; open &= open - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(open));
      if (!is_inside(static_cast<std::uint32_t>(first + 64 * i + bit)))
        found.points[i] &= ~(std::uint64_t{1} << bit);
    }
  }
}

// Their numbers, given bits and how many of them are set in each part.
std::vector<std::uint32_t> numbers_of(std::span<const std::uint64_t> bits,
                                      const std::vector<std::size_t>& counts) {
  std::vector<std::size_t> begins(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), begins.begin() + 1);
  std::vector<std::uint32_t> numbers;
  reserve_large(numbers, begins.back());
  numbers.resize(begins.back());
  for_each_chunk(bits.size(), points_a_part / 64, [&](const Chunk& chunk) {
    write_numbers(bits.subspan(chunk.first, chunk.last - chunk.first),
                  static_cast<std::uint32_t>(64 * chunk.first),
                  std::span(numbers).subspan(begins[chunk.number], counts[chunk.number]));
  });
  return numbers;
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
    if (!scan.positions[id].allFinite()) return false;  // as scan.finite has it, but at hand
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
  const std::size_t words = (scan.size() + 63) / 64;
  const auto bits = std::make_unique_for_overwrite<std::uint64_t[]>(words);
  std::vector<std::size_t> counts(chunk_count(scan.size(), points_a_part));
  for_each_chunk(scan.size(), points_a_part, [&](const Chunk& chunk) {
    LassoCandidates found;
    for (std::size_t first = chunk.first; first < chunk.last; first += block) {
      const std::size_t count = std::min(block, chunk.last - first);
      find_candidates(cells, grid, scan.positions[first].data(), count, found);
      decide(found, first, is_inside);
      std::copy_n(found.points.begin(), (count + 63) / 64, bits.get() + first / 64);
      counts[chunk.number] += count_bits(found.points);
    }
  });
  return numbers_of({bits.get(), words}, counts);
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
