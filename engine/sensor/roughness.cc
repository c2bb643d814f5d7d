#include "engine/sensor/roughness.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/scan/neighbours.h"

namespace patchlab {
namespace {

constexpr std::size_t smallest_neighbourhood = 16;
constexpr std::size_t largest_neighbourhood = 256;
constexpr double flat = 0.2;  // thickness over width of a neighbourhood that counts as a plane

// Variance about the plane through the first `size` neighbours, when they are flat: the plane has three
// parameters.
std::optional<double> variance_about_plane(const Scan& scan, const std::vector<Neighbour>& neighbours,
                                           std::size_t size) {
  const Eigen::Vector3d centre = scan.positions[neighbours.front().id].cast<double>();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3d offset = scan.positions[neighbours[i].id].cast<double>() - centre;
    mean += offset;
    scatter += offset * offset.transpose();
  }
  const double count = static_cast<double>(size);
  scatter -= mean * mean.transpose() / count;
  const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
  if (!(spread(0) < flat * flat * spread(1))) return std::nullopt;
  return std::max(spread(0), 0.0) / (count - 3.0);
}

std::optional<double> variance_where_flat(const Scan& scan, const std::vector<Neighbour>& neighbours) {
  for (std::size_t size = smallest_neighbourhood; size <= neighbours.size(); size *= 2) {
    if (const auto variance = variance_about_plane(scan, neighbours, size)) return variance;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> local_roughness(const Scan& scan, std::size_t samples) {
  if (scan.finite_count < smallest_neighbourhood) return std::nullopt;
  const NeighbourIndex index(scan);
  const std::size_t stride = std::max<std::size_t>(scan.size() / samples, 1);
  std::vector<Neighbour> neighbours;
  std::vector<double> variances;
  for (std::size_t i = 0; i < scan.size(); i += stride) {
    if (!scan.finite[i]) continue;
    index.nearest(scan.positions[i], largest_neighbourhood, neighbours);
    if (const auto variance = variance_where_flat(scan, neighbours)) variances.push_back(*variance);
  }
  if (variances.empty()) return std::nullopt;
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::sqrt(*middle);
}

}  // namespace patchlab
