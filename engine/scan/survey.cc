#include "engine/scan/survey.h"

#include <algorithm>
#include <tuple>

namespace patchlab {
namespace {

using Positions = std::vector<Eigen::Vector3f>;

Positions finite_positions(const Scan& scan) {
  Positions positions;
  positions.reserve(scan.finite_count);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i]) positions.push_back(scan.positions[i]);
  }
  return positions;
}

// The value with this share of the others below it.
float quantile(std::vector<float>& values, double share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

std::size_t count_duplicates(Positions positions) {
  const auto key = [](const Eigen::Vector3f& p) { return std::tuple(p.x(), p.y(), p.z()); };
  std::ranges::sort(positions, {}, key);
  std::size_t duplicates = 0;
  for (std::size_t i = 1; i < positions.size(); ++i) duplicates += positions[i] == positions[i - 1] ? 1 : 0;
  return duplicates;
}

std::size_t count_far(const Positions& positions) {
  std::vector<float> values(positions.size());
  Eigen::Vector3f middle;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::ranges::transform(positions, values.begin(), [&](const Eigen::Vector3f& p) { return p(axis); });
    middle(axis) = quantile(values, 0.5);
  }
  std::ranges::transform(positions, values.begin(),
                         [&](const Eigen::Vector3f& p) { return (p - middle).stableNorm(); });
  const double limit = far_factor * static_cast<double>(quantile(values, 0.9));
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [&](float distance) { return static_cast<double>(distance) > limit; }));
}

}  // namespace

Survey survey(const Scan& scan) {
  Positions positions = finite_positions(scan);
  if (positions.empty()) return {};
  const std::size_t far_outliers = count_far(positions);
  return {count_duplicates(std::move(positions)), far_outliers};
}

}  // namespace patchlab
