#include "engine/sensor/roughness.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/random.h"
#include "engine/scan/neighbours.h"

namespace patchlab {
namespace {

constexpr std::size_t smallest_neighbourhood = 16;
constexpr std::size_t largest_neighbourhood = 256;
constexpr double flat =
    0.2;  // a neighbourhood thinner than this times its width is a plane, a narrower one a line

constexpr std::size_t points_enough = std::size_t{1} << 19;

// Of a large scan as many points as a neighbourhood needs to be small, drawn evenly: a tree of all of them
// would take more memory than the scan itself.
Scan thinned(const Scan& scan) {
  Scan drawn;
  Random random(1);
  const double share = static_cast<double>(points_enough) / static_cast<double>(scan.finite_count);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i] && random.uniform() < share) drawn.positions.push_back(scan.positions[i]);
  }
  drawn.finite.assign(drawn.positions.size(), 1);
  drawn.finite_count = drawn.positions.size();
  return drawn;
}

// Scans put together from several often hold a point many times; it counts once. Equal points are equally far
// away.
void drop_repeated(const Scan& scan, std::vector<Neighbour>& neighbours) {
  std::size_t kept = 0;
  for (const Neighbour& neighbour : neighbours) {
    bool repeated = false;
    for (std::size_t i = kept; i-- > 0 && neighbours[i].squared_distance == neighbour.squared_distance;) {
      repeated = repeated || scan.positions[neighbours[i].id] == scan.positions[neighbour.id];
    }
    if (!repeated) neighbours[kept++] = neighbour;
  }
  neighbours.resize(kept);
}

// Variance about the plane of the neighbours, which has three parameters, when they are flat and no line.
std::optional<double> variance_about_plane(const Scan& scan, const std::vector<Neighbour>& neighbours) {
  const Eigen::Vector3d first = scan.positions[neighbours.front().id].cast<double>();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Neighbour& neighbour : neighbours) {
    const Eigen::Vector3d offset = scan.positions[neighbour.id].cast<double>() - first;
    sum += offset;
    scatter += offset * offset.transpose();
  }
  const double count = static_cast<double>(neighbours.size());
  scatter -= sum * sum.transpose() / count;
  const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
  const bool is_flat = spread(0) < flat * flat * spread(1) && spread(1) > flat * flat * spread(2);
  if (!is_flat) return std::nullopt;
  return std::max(spread(0), 0.0) / (count - 3.0);
}

std::optional<double> variance_around(const Scan& scan, const NeighbourIndex& index, std::size_t point,
                                      std::vector<Neighbour>& neighbours) {
  for (std::size_t size = smallest_neighbourhood; size <= largest_neighbourhood; size *= 2) {
    index.nearest(scan.positions[point], size, neighbours);
    drop_repeated(scan, neighbours);
    if (neighbours.size() < smallest_neighbourhood) continue;
    if (const auto variance = variance_about_plane(scan, neighbours)) return variance;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> local_roughness(const Scan& scan, std::size_t samples) {
  if (scan.finite_count < smallest_neighbourhood) return std::nullopt;
  if (scan.finite_count > 2 * points_enough) return local_roughness(thinned(scan), samples);
  const NeighbourIndex index(scan);
  const std::size_t stride = std::max<std::size_t>(scan.size() / samples, 1);
  std::vector<Neighbour> neighbours;
  std::vector<double> variances;
  for (std::size_t i = 0; i < scan.size(); i += stride) {
    if (!scan.finite[i]) continue;
    if (const auto variance = variance_around(scan, index, i, neighbours)) variances.push_back(*variance);
  }
  if (variances.empty()) return std::nullopt;
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::sqrt(*middle);
}

}  // namespace patchlab
