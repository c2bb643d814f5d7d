#include "engine/fit/robust.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/random.h"
#include "engine/fit/sample_rows.h"

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

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// One draw's quadric beside all points.
struct Drawn {
  Quadric quadric;
  std::vector<double> sizes;  // |F|

  double truncated_cost() const {
    double cost = 0.0;
    for (const double F : sizes) cost += std::min(F * F, flag_limit * flag_limit);
    return cost;
  }
};

Drawn beside(const Quadric& quadric, const Samples& samples) {
  Drawn drawn{quadric, std::vector<double>(samples.size())};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    drawn.sizes[i] = std::abs(quadric_residual(quadric, samples, i));
  }
  return drawn;
}

// 1 for the points within a limit; how many those are.
std::size_t keep_within(Samples& samples, const Quadric& quadric, double limit) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples.robust[i] = std::abs(quadric_residual(quadric, samples, i)) <= limit ? 1.0 : 0.0;
    kept += samples.robust[i] > 0.0 ? 1 : 0;
  }
  return kept;
}

}  // namespace

bool keep_quadric_inliers(Samples& samples, std::uint64_t seed) {
  Random random(seed);
  const SurfaceState plane = initial_plane(samples);
  Quadric of_least_cost, of_least_median;
  double least_cost = std::numeric_limits<double>::infinity(), least_median = least_cost;
  for (int i = 0; i < draws; ++i) {
    Drawn drawn = beside(quadric_through(samples, plane, draw(random, samples.size())), samples);
    if (const double cost = drawn.truncated_cost(); cost < least_cost) {
      least_cost = cost;
      of_least_cost = drawn.quadric;
    }
    if (const double middle = median(drawn.sizes); middle < least_median) {
      least_median = middle;
      of_least_median = drawn.quadric;
    }
  }
  if (2 * keep_within(samples, of_least_cost, flag_limit) >= samples.size()) return true;
  keep_within(samples, of_least_median, least_median);
  return false;
}

double residual_scale(const Samples& samples, const SurfaceFit& fit) {
  constexpr double median_of_normal = 0.6745;
  constexpr double does_not_count = -1.0;
  std::vector<double> sizes(samples.size());
  for_each_residual(SampleRows(samples, fit.model, fit.state, Distance::exact),
                    [&](std::size_t i, const Residual& r) {
                      const bool counts = samples.robust[i] != 0.0 && samples.bends[i] != 0;
                      sizes[i] = counts ? std::abs(r.F) : does_not_count;
                    });
  std::erase(sizes, does_not_count);
  return sizes.empty() ? 1.0 : median(sizes) / median_of_normal;
}

double robust_scale(const Samples& samples, const SurfaceFit& fit) {
  constexpr double holds = 0.8, least = 0.2;
  const double scale = residual_scale(samples, fit);
  return scale > holds ? 1.0 : std::max(scale, least);
}

void flag_outliers(Samples& samples, const SurfaceFit& fit, double scale) {
  for_each_residual(SampleRows(samples, fit.model, fit.state, Distance::exact),
                    [&](std::size_t i, const Residual& r) {
                      const double F = r.F / scale;
                      samples.robust[i] = std::abs(F) > flag_limit ? 0.0 : tukey_weight(F);
                    });
}

}  // namespace patchlab
