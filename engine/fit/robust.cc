#include "engine/fit/robust.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/random.h"

namespace patchlab {
namespace {

constexpr std::size_t draw_size = 9;
constexpr int draws = 80;

std::vector<std::size_t> draw(Random& random, std::size_t n) {
  std::vector<std::size_t> points;
  while (points.size() < std::min(draw_size, n)) {
    const std::size_t i = random.index(n);
    if (std::find(points.begin(), points.end(), i) == points.end()) points.push_back(i);
  }
  return points;
}

double truncated_cost(const Quadric& quadric, const Samples& samples) {
  double cost = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double F = quadric_residual(quadric, samples, i);
    cost += std::min(F * F, flag_limit * flag_limit);
  }
  return cost;
}

}  // namespace

void keep_quadric_inliers(Samples& samples, std::uint64_t seed) {
  Random random(seed);
  const SurfaceState plane = initial_plane(samples);
  Quadric best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < draws; ++i) {
    const Quadric quadric = quadric_through(samples, plane, draw(random, samples.size()));
    const double cost = truncated_cost(quadric, samples);
    if (cost < least) {
      least = cost;
      best = quadric;
    }
  }
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples.robust[i] = std::abs(quadric_residual(best, samples, i)) <= flag_limit ? 1.0 : 0.0;
    inliers += samples.robust[i] > 0.0 ? 1 : 0;
  }
  if (2 * inliers < samples.size()) samples.robust.assign(samples.size(), 1.0);  // no quadric holds them
}

double robust_scale(const Samples& samples, const SurfaceFit& fit) {
  constexpr double median_of_normal = 0.6745, holds = 0.8, least = 0.2;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples.robust[i] == 0.0) continue;
    sizes.push_back(
        std::abs(residual(Distance::exact, fit.model, fit.state, samples.q[i], samples.cov[i]).F));
  }
  if (sizes.empty()) return 1.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double scale = *middle / median_of_normal;
  return scale > holds ? 1.0 : std::max(scale, least);
}

void flag_outliers(Samples& samples, const SurfaceFit& fit, double scale) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double F = residual(Distance::exact, fit.model, fit.state, samples.q[i], samples.cov[i]).F / scale;
    samples.robust[i] = std::abs(F) > flag_limit ? 0.0 : tukey_weight(F);
  }
}

}  // namespace patchlab
