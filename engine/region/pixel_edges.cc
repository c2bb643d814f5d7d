#include "engine/region/pixel_edges.h"

#include <algorithm>
#include <cmath>

namespace patchlab {
namespace {

constexpr double jump = 0.02;  // of the depth

class Grid {
 public:
  explicit Grid(const Scan& scan) : scan_(scan), axis_(rotation(scan.viewpoint).col(2)) {}

  bool at_edge(std::uint32_t id) const {
    const double here = depth(id);
    const std::int64_t row = id / scan_.width, column = id % scan_.width;
    for (std::int64_t r = row - 1; r <= row + 1; ++r) {
      for (std::int64_t c = column - 1; c <= column + 1; ++c) {
        if (r < 0 || c < 0 || r >= scan_.height || c >= scan_.width) continue;
        const auto neighbour = static_cast<std::uint32_t>(r * scan_.width + c);
        if (!scan_.finite[neighbour] || std::abs(depth(neighbour) - here) > jump * std::abs(here))
          return true;
      }
    }
    return false;
  }
  // Between this pixel's ray and the next one's of its row; 0 where there is none.
  double pitch(std::uint32_t id) const {
    if (id % scan_.width + 1 == scan_.width || !scan_.finite[id + 1]) return 0.0;
    return (ray(id) - ray(id + 1)).norm();
  }

 private:
  Eigen::Vector3d from_sensor(std::uint32_t id) const { return scan_.point(id) - scan_.viewpoint.position; }
  Eigen::Vector3d ray(std::uint32_t id) const { return from_sensor(id).normalized(); }
  double depth(std::uint32_t id) const { return axis_.dot(from_sensor(id)); }

  const Scan& scan_;
  Eigen::Vector3d axis_;
};

}  // namespace

PixelEdges pixel_edges(const Scan& scan, std::span<const std::uint32_t> ids) {
  PixelEdges edges;
  if (!scan.organized() || !scan.viewpoints.empty()) return edges;
  const Grid grid(scan);
  std::vector<double> pitches;
  for (const std::uint32_t id : ids) {
    edges.at_edge.push_back(grid.at_edge(id) ? 1 : 0);
    if (const double pitch = grid.pitch(id); pitch > 0.0) pitches.push_back(pitch);
  }
  if (pitches.empty()) return edges;
  const auto middle = pitches.begin() + static_cast<std::ptrdiff_t>(pitches.size() / 2);
  std::nth_element(pitches.begin(), middle, pitches.end());
  edges.pitch = *middle;
  return edges;
}

}  // namespace patchlab
