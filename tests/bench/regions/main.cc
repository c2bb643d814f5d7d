// regions_bench [--page FILE]: 21 regions of a scan fitted as a hand would choose them, beside Ceres; and
// fits about more and more of its pixels.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "engine/base/parallel.h"
#include "engine/region/observe.h"
#include "engine/scan/neighbours.h"
#include "tests/bench/fit/solvers.h"
#include "tests/bench/grid/scene.h"
#include "tests/bench/round_robin/round_robin.h"

namespace patchlab::bench {
namespace {

using PointIds = std::vector<std::uint32_t>;

// The points within a radius of one, at most about `most` of them, evenly left out.
PointIds ball(const Scan& scan, std::uint32_t seed, float radius, std::size_t most) {
  const Eigen::Vector3f here = scan.positions[seed];
  PointIds pixels, inside;
  grid_neighbours(scan, seed, static_cast<std::uint32_t>(1.5F * 525.0F * radius / here.z()), pixels);
  for (const std::uint32_t id : pixels) {
    if ((scan.positions[id] - here).squaredNorm() <= radius * radius) inside.push_back(id);
  }
  const std::size_t step = 1 + inside.size() / most;
  PointIds kept;
  for (std::size_t i = 0; i < inside.size(); i += step) kept.push_back(inside[i]);
  return kept;
}

struct Regions {
  std::vector<PointIds> ids;
  std::vector<Observations> observations;
  std::vector<Samples> samples;
  std::vector<Points> points_of_samples;
  std::vector<SurfaceState> starts;
  std::size_t points = 0;
};

// On boulders, away from their edges.
Regions choose_regions(const SeenScene& scene, const NoiseModel& noise) {
  constexpr std::size_t sizes[] = {150, 300, 600, 1000, 1500, 3000, 3000};
  const std::uint32_t ground = *std::ranges::max_element(scene.scan.labels);
  PointIds pixels;
  for (std::uint32_t id = 0; id < scene.scan.size(); ++id) {
    if (scene.scan.finite[id] && !scene.near_edge[id] && scene.scan.labels[id] != ground)
      pixels.push_back(id);
  }
  Regions regions;
  for (std::uint32_t i = 0; i < 21; ++i) {
    const std::uint32_t seed = pixels[(2 * i + 1) * pixels.size() / 42];
    regions.ids.push_back(ball(scene.scan, seed, 0.06F + 0.002F * static_cast<float>(i), sizes[i % 7]));
    regions.observations.push_back(*observe(scene.scan, noise, regions.ids.back()));
    regions.observations.back().at_edge.clear();  // Ceres fits all points, and so shall both
    regions.points += regions.ids.back().size();
  }
  for (const Observations& observations : regions.observations) {
    regions.samples.push_back(*make_samples(observations, 10));
    regions.points_of_samples.push_back(points_of(regions.samples.back()));
    regions.starts.push_back(quadratic_start(regions.samples.back()));
  }
  return regions;
}

std::string regions_table(const SeenScene& scene, const NoiseModel& noise) {
  const Scan& scan = scene.scan;
  const Regions regions = choose_regions(scene, noise);
  const Objective paper;
  const std::size_t n = regions.samples.size();
  std::vector<Solved> mine(n), theirs(n);
  RoundRobin times(9);
  const auto fit_all = [&] {
    for_each_chunk(n, 1,
                   [&](const Chunk& one) { mine[one.first] = ours(regions.samples[one.first], paper); });
  };
  const auto from_scan = [&] {
    for (std::size_t i = 0; i < n; ++i) {
      Observations observations = *observe(scan, noise, regions.ids[i]);
      observations.at_edge.clear();
      mine[i] = ours(*make_samples(observations, 10), paper);
    }
  };
  times.add("ours", fit_all);
  times.add("ours, two threads", fit_all, 2);
  times.add(
      "one thread on the wall",
      [&] {
        for (std::size_t i = 0; i < n; ++i) mine[i] = ours(regions.samples[i], paper);
      },
      2);
  times.add("with covariances", from_scan);
  if (has_ceres()) {
    times.add("Ceres", [&] {
      for (std::size_t i = 0; i < n; ++i)
        theirs[i] = ceres(Ceres::normal_cholesky, regions.points_of_samples[i], paper, regions.starts[i]);
    });
  }
  times.run();
  double evaluations = 0.0, theirs_evaluations = 0.0, higher = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    evaluations += mine[i].evaluations / static_cast<double>(n);
    theirs_evaluations += theirs[i].evaluations / static_cast<double>(n);
    higher = std::max(higher, mine[i].chi2 / theirs[i].chi2 - 1.0);
  }
  std::string text = "| " + std::to_string(n) + " regions, " + std::to_string(regions.points) +
                     " points, the paper's objective | time | times the first |\n|---|---|---|\n";
  const auto line = [&](const char* words, const char* name) {
    text += "| " + std::string(words) + " | " + time_of(times, name) + " | " + ratio_of(times, name, "ours") +
            " |\n";
  };
  line("surfaces and their covariances", "ours");
  line("the same, points' covariances from the noise model included", "with covariances");
  line(
      "Ceres, analytic rows, normal equations, `ceres::Covariance`, from the same starts, which are not timed",
      "Ceres");
  char more[256];
  std::snprintf(more, sizeof more, "\nOn two threads %s the time of one. Evaluations: %.1f",
                ratio_of(times, "ours, two threads", "one thread on the wall").c_str(), evaluations);
  text += more;
  if (has_ceres()) {
    std::snprintf(more, sizeof more, ", Ceres %.1f; χ² is at most %.1e of it higher than Ceres's",
                  theirs_evaluations, higher);
    text += more;
  }
  return text + ".\n";
}

// About a pixel: every `step`th of a window `reach` pixels each way.
void window(const Scan& scan, std::uint32_t seed, std::uint32_t reach, std::uint32_t step, PointIds& ids) {
  const std::uint32_t row = seed / scan.width, column = seed % scan.width;
  ids.clear();
  for (std::uint32_t r = row - std::min(row, reach); r <= std::min(row + reach, scan.height - 1); r += step) {
    for (std::uint32_t c = column - std::min(column, reach); c <= std::min(column + reach, scan.width - 1);
         c += step) {
      const std::uint32_t id = r * scan.width + c;
      if (scan.finite[id] && (scan.positions[id] - scan.positions[seed]).squaredNorm() < 0.01F * 0.75F)
        ids.push_back(id);
    }
  }
}

// Fits about every `step`th pixel that has a depth: gathered, with covariances, six parameters.
class SeedFits {
 public:
  SeedFits(const Scan& scan, const NoiseModel& noise, std::size_t step) : scan_(scan), noise_(noise) {
    std::size_t valid = 0;
    for (std::uint32_t id = 0; id < scan.size(); ++id) {
      if (scan.finite[id] && valid++ % step == 0) seeds_.push_back(id);
    }
    points_.resize(seeds_.size());
    chi2_.resize(seeds_.size());
  }
  void fit_all() {
    for_each_chunk(seeds_.size(), 16, [&](const Chunk& chunk) {
      PointIds ids;
      for (std::size_t i = chunk.first; i < chunk.last; ++i) fit(i, ids);
    });
  }
  std::size_t size() const { return seeds_.size(); }
  std::size_t fitted() const {
    return size() - static_cast<std::size_t>(std::ranges::count(points_, std::size_t{0}));
  }
  double mean_points() const {
    return std::accumulate(points_.begin(), points_.end(), 0.0) / static_cast<double>(fitted());
  }

 private:
  void fit(std::size_t i, PointIds& ids) {
    static const SurfaceModel model = fixed_centre(surface_model(ModelKind::paraboloid));
    const auto reach = static_cast<std::uint32_t>(525.0F * 0.075F / scan_.positions[seeds_[i]].z());
    window(scan_, seeds_[i], reach, 1 + reach / 5, ids);
    const Result<Observations> observations = observe(scan_, noise_, ids);
    const Result<Samples> samples = make_samples(*observations, 10);
    if (!samples) return;
    SurfaceFitOptions options;
    options.distance = Distance::paper;
    chi2_[i] = fit_surface(*samples, model, quadratic_start(*samples), options).chi2;
    points_[i] = samples->size();
  }

  const Scan& scan_;
  const NoiseModel& noise_;
  PointIds seeds_;
  std::vector<std::size_t> points_;  // of each fit, 0 where there is none
  std::vector<double> chi2_;
};

std::string seeds_table(const Scan& scan, const NoiseModel& noise) {
  constexpr std::size_t steps[] = {848, 212, 53};
  std::vector<SeedFits> fits;
  for (const std::size_t step : steps) fits.emplace_back(scan, noise, step);
  RoundRobin times(7);
  for (SeedFits& some : fits) {
    times.add(std::to_string(some.size()), [&some] { some.fit_all(); });
    times.add(
        std::to_string(some.size()) + " by two", [&some] { some.fit_all(); }, 2);
  }
  times.run();
  std::string table =
      "\n| fits about pixels all over the scan, six parameters, gathered, with covariances | points of each | time "
      "| of each | grows as their number to the | two threads, times the least of one |\n|---|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const std::string name = std::to_string(fits[k].size());
    const double ms = times.median_ms(name);
    table += "| " + name + ", " + std::to_string(fits[k].fitted()) + " of them fitted | " +
             text("%.0f", fits[k].mean_points()) + " | " + time_of(times, name) + " | " +
             text("%.1f µs", 1e3 * ms / static_cast<double>(fits[k].size())) + " | ";
    if (k > 0) {
      const double before = times.median_ms(std::to_string(fits[k - 1].size()));
      table += text("%.2f", std::log(ms / before) / std::log(static_cast<double>(fits[k].size()) /
                                                             static_cast<double>(fits[k - 1].size())));
    }
    table += " | " + text("%.2f ×", times.least_ms(name + " by two") / times.least_ms(name)) + " |\n";
  }
  return table;
}

}  // namespace
}  // namespace patchlab::bench

int main(int argc, char** argv) {
  using namespace patchlab::bench;
  const patchlab::NoiseModel kinect = *patchlab::noise_model("kinect1");
  const SeenScene scene = ground_and_boulders(kinect);
  const std::string text =
      date_and_machine() +
      ". The scan of the normals. Medians of processor time, half of the middle half as ±; two threads: least times.\n\n" +
      regions_table(scene, kinect) + seeds_table(scene.scan, kinect);
  return report(argc, argv, "regions", text);
}
