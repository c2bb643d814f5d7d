#include "engine/region/pixel_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlab {
namespace {

constexpr double jump = 0.02;                             // of the depth
constexpr double noise_jump = 4.0 * std::numbers::sqrt2;  // standard deviations

class Grid {
 public:
  explicit Grid(const Scan& scan) : scan_(scan), axis_(rotation(scan.viewpoint).col(2)) {}

  bool at_edge(std::uint32_t id, double sigma) const {
    const double here = depth(id), most = std::max(jump * std::abs(here), noise_jump * sigma);
    const std::int64_t row = id / scan_.width, column = id % scan_.width;
    for (std::int64_t r = row - 1; r <= row + 1; ++r) {
      for (std::int64_t c = column - 1; c <= column + 1; ++c) {
        if (r < 0 || c < 0 || r >= scan_.height || c >= scan_.width) continue;
        const auto neighbour = static_cast<std::uint32_t>(r * scan_.width + c);
        if (!scan_.finite[neighbour] || std::abs(depth(neighbour) - here) > most) return true;
      }
    }
    return false;
  }

 private:
  double depth(std::uint32_t id) const { return axis_.dot(scan_.point(id) - scan_.viewpoint.position); }

  const Scan& scan_;
  Eigen::Vector3d axis_;
};

}  // namespace

std::vector<std::uint8_t> pixel_edges(const Scan& scan, std::span<const std::uint32_t> ids,
                                      std::span<const double> sigmas) {
  std::vector<std::uint8_t> at_edge;
  if (!scan.organized() || !scan.viewpoints.empty()) return at_edge;
  const Grid grid(scan);
  at_edge.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) at_edge.push_back(grid.at_edge(ids[i], sigmas[i]) ? 1 : 0);
  return at_edge;
}

}  // namespace patchlab
