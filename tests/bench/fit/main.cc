// fit_bench [--readme FILE] [Google Benchmark's options]: fits of the engine, of Ceres and of Eigen,
// interleaved, in CPU time of one thread, nine repetitions each; the arithmetic of the same fits in the same
// run. --readme writes the table.
#include <sys/resource.h>
#include <tbb/task_arena.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "engine/fit/fit_model.h"
#include "engine/fit/fit_patch.h"
#include "engine/fit/steps.h"
#include "tests/bench/fit/arithmetic.h"
#include "tests/bench/fit/height_field.h"
#include "tests/bench/fit/patches.h"
#include "tests/bench/fit/solvers.h"
#include "tests/bench/fit/table.h"
#include "tests/bench/page/page.h"

namespace patchlab::bench {
namespace {

// Patches of one size, with what all their fits share.
struct Set {
  std::size_t points;
  std::vector<Observations> observations;
  std::vector<Samples> samples;
  std::vector<Points> points_of_samples;
  std::vector<SurfaceState> starts;
  std::vector<Objective> calibrated;
  double evaluations = 0.0;  // mean, of ours
};

Set observed(std::size_t points, std::vector<Observations> all) {
  Set set{points, std::move(all), {}, {}, {}, {}, 0.0};
  set.samples = samples_of(set.observations);
  for (const Samples& samples : set.samples) set.points_of_samples.push_back(points_of(samples));
  return set;
}

Set make_set(std::size_t points, std::vector<Observations> all) {
  Set set = observed(points, std::move(all));
  for (Samples& samples : set.samples) {
    set.starts.push_back(quadratic_start(samples));
    const SurfaceModel held = fixed_centre(surface_model(ModelKind::paraboloid));
    const SurfaceFit fixed = fit_surface(samples, held, set.starts.back(), {});
    set.calibrated.push_back({Distance::exact, vertex_start(samples, fixed).prior});
    set.evaluations += ours(samples, {}).evaluations / static_cast<double>(set.samples.size());
  }
  return set;
}

// Threads: of the fits that run at once, and of each of them.
struct Threads {
  int beside = 1, within = 1;
};

// `one` of every patch of the set.
template <class One>
void add(const std::string& name, const Set& set, One one, Threads threads = {}) {
  const auto all = [&set, one, threads](benchmark::State& state) {
    tbb::task_arena(threads.within).execute([&] {
      for (auto _ : state) {
        for (std::size_t i = 0; i < set.samples.size(); ++i) benchmark::DoNotOptimize(one(i));
      }
    });
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * set.samples.size()));
  };
  auto* benchmark = benchmark::RegisterBenchmark((name + "/" + std::to_string(set.points)).c_str(), all);
  benchmark->Unit(benchmark::kMicrosecond)
      ->Repetitions(set.points > 2000 ? 5 : 9)
      ->MinTime(set.points > 2000 ? 0.02 : 0.05)
      ->Threads(threads.beside);
  if (threads.beside > 1 || threads.within > 1) {
    benchmark->UseRealTime();
  } else {
    benchmark->MeasureProcessCPUTime();  // Ceres may call libraries that have threads of their own
  }
}

FitOptions fit_options(FitMethod method, SurfaceRequest surface) {
  FitOptions options;
  options.method = method;
  options.surface = surface;
  return options;
}

FitResult whole(const Observations& observations, FitMethod method, SurfaceRequest surface) {
  return *fit_patch(observations, fit_options(method, surface));
}

// Of a whole fit steps 1 to 3 alone, from samples that are ready.
void add_surfaces(const std::string& name, const Set& set, FitMethod method) {
  auto all = std::make_shared<std::vector<Workbench>>();
  for (const Observations& observations : set.observations)
    all->push_back(*begin(observations, fit_options(method, SurfaceRequest::elliptic_paraboloid)));
  add(name, set, [all](std::size_t i) {
    Workbench& work = (*all)[i];
    work.fits.clear();
    work.log.clear();
    fit_plane(work);
    fit_surfaces(work);
    refine_type(work);
    return work.surface.chi2;
  });
}

void add_all(const Set& set) {
  const static Objective paper;
  add("arithmetic", set, [&](std::size_t) {
    return arithmetic(
        static_cast<std::size_t>(flops_per_point * set.evaluations * static_cast<double>(set.points)));
  });
  add("ours", set, [&](std::size_t i) { return ours(set.samples[i], paper); });
  add("ours, two at once", set, [&](std::size_t i) { return ours(set.samples[i], paper); }, {2, 1});
  add("ours, shared", set, [&](std::size_t i) { return ours(set.samples[i], paper); }, {1, 2});
  add("ours exact", set, [&](std::size_t i) { return ours(set.samples[i], set.calibrated[i]); });
  add("height field", set, [&](std::size_t i) { return height_field_fit(set.observations[i].points); });
  const auto both = SurfaceRequest::elliptic_paraboloid;
  add_surfaces("surface of whole paper", set, FitMethod::paper);
  add_surfaces("surface of whole calibrated", set, FitMethod::calibrated);
  add("whole paper", set, [&](std::size_t i) { return whole(set.observations[i], FitMethod::paper, both); });
  add("whole calibrated", set,
      [&](std::size_t i) { return whole(set.observations[i], FitMethod::calibrated, both); });
  add("whole calibrated, shared", set,
      [&](std::size_t i) { return whole(set.observations[i], FitMethod::calibrated, both); }, {1, 2});
  add("whole automatic", set, [&](std::size_t i) {
    return whole(set.observations[i], FitMethod::calibrated, SurfaceRequest::automatic);
  });
  if (!has_ceres()) return;
  const auto by_ceres = [&](const char* name, Ceres way, bool exact) {
    add(name, set, [&set, way, exact](std::size_t i) {
      return ceres(way, set.points_of_samples[i], exact ? set.calibrated[i] : Objective{}, set.starts[i]);
    });
  };
  by_ceres("Ceres Cholesky", Ceres::normal_cholesky, false);
  by_ceres("Ceres QR", Ceres::qr, false);
  by_ceres("Ceres exact", Ceres::normal_cholesky, true);
  if (set.points <= 1500) by_ceres("Ceres per point", Ceres::per_point, false);
}

// The paper's objective, without a prior and with one.
void add_mixed(const Set& set) {
  const auto objective = [&set](std::size_t i, bool with_prior) {
    return with_prior ? Objective{Distance::paper, set.calibrated[i].prior} : Objective{};
  };
  for (const bool with_prior : {false, true}) {
    const std::string name = with_prior ? "mixed, prior" : "mixed";
    add("ours " + name, set,
        [=, &set](std::size_t i) { return ours(set.samples[i], objective(i, with_prior)); });
    if (!has_ceres()) continue;
    add("Ceres " + name, set, [=, &set](std::size_t i) {
      return ceres(Ceres::normal_cholesky, set.points_of_samples[i], objective(i, with_prior), set.starts[i]);
    });
  }
}

void add_for_scaling(const Set& set) {
  const static Objective paper;
  const auto both = SurfaceRequest::elliptic_paraboloid;
  add("ours", set, [&](std::size_t i) { return ours(set.samples[i], paper); });
  add("whole calibrated", set,
      [&](std::size_t i) { return whole(set.observations[i], FitMethod::calibrated, both); });
}

// How far results lie from a tight optimum: chi-square relative, apex in its own standard deviations.
void print_accuracy(const Set& set) {
  double gap_ours = 0.0, gap_ceres = 0.0, log_det = 0.0;
  const auto n = static_cast<double>(set.samples.size());
  for (std::size_t i = 0; i < set.samples.size(); ++i) {
    const Solved tight = ours(set.samples[i], {}, 1e-14), loose = ours(set.samples[i], {});
    gap_ours += (loose.chi2 / tight.chi2 - 1.0) / n;
    log_det += std::abs(std::log(loose.cov.determinant() / tight.cov.determinant())) / n;
    if (has_ceres()) {
      gap_ceres +=
          (ceres(Ceres::normal_cholesky, set.points_of_samples[i], {}, set.starts[i]).chi2 / tight.chi2 -
           1.0) /
          n;
    }
  }
  std::printf(
      "%zu points: %.1f evaluations; chi-square above a tight optimum: ours %.1e, Ceres %.1e; |log det| %.1e\n",
      set.points, set.evaluations, gap_ours, gap_ceres, log_det);
}

// A row of the table: what was timed, and how many times the time of `beside` that is.
struct Line {
  const char* words;
  const char* name;
  const char* beside;
};
constexpr Line lines[] = {
    {"surface and its covariance, the paper's objective", "ours", nullptr},
    {"the same by Ceres: analytic rows, normal equations, `ceres::Covariance`", "Ceres Cholesky", "ours"},
    {"the same by Ceres, QR", "Ceres QR", "ours"},
    {"the same by Ceres, automatic derivatives, one residual a point", "Ceres per point", "ours"},
    {"two at once, each on a thread, the time of one", "ours, two at once", "ours"},
    {"one shared by two threads (from 1800 points on)", "ours, shared", "ours"},
    {"nothing but the arithmetic of its evaluations", "arithmetic", "ours"},
    {"an unweighted height field by Eigen, no covariance", "height field", "ours"},
    {"surface and its covariance, exact distance and prior (calibrated)", "ours exact", "ours"},
    {"the same by Ceres", "Ceres exact", "ours exact"},
    {"72 patches of many shapes, mean, the paper's objective", "ours mixed", "ours"},
    {"the same by Ceres", "Ceres mixed", "ours mixed"},
    {"72 patches of many shapes, mean, with the prior of the vertex", "ours mixed, prior", "ours"},
    {"the same by Ceres", "Ceres mixed, prior", "ours mixed, prior"},
    {"the surface of the paper's nine steps, which starts flat: steps 1 to 3", "surface of whole paper",
     "ours"},
    {"all nine of them: checks, surface, bound, covariance of all, validation", "whole paper",
     "surface of whole paper"},
    {"the surface of a calibrated fit, type named: steps 1 to 3", "surface of whole calibrated",
     "ours exact"},
    {"all nine steps of it", "whole calibrated", "surface of whole calibrated"},
    {"the same shared by two threads", "whole calibrated, shared", "whole calibrated"},
    {"whole calibrated fit, type chosen among seven", "whole automatic", "ours exact"},
};

std::string table(const Collector& times, const std::vector<Set>& sets) {
  std::string text =
      when_and_where() +
      ". Medians of CPU time of interleaved repetitions, half of the middle half of them as ±; ×: times the "
      "line that it is beside.\n\n| one fit |";
  for (const Set& set : sets) text += " " + std::to_string(set.points) + " points |";
  text += "\n|---|";
  for (std::size_t i = 0; i < sets.size(); ++i) text += "---|";
  for (const Line& line : lines) {
    text += "\n| " + std::string(line.words) + " |";
    for (const Set& set : sets) {
      const std::string at = "/" + std::to_string(set.points);
      const double us = times.median(line.name + at);
      text += " " + duration(us, times.spread(line.name + at));
      if (line.beside != nullptr) text += ratio(us, times.median(line.beside + at));
      text += " |";
    }
  }
  return text + "\n";
}

// Exponents from one size to the next.
std::string scaling(const Collector& times, const std::vector<std::size_t>& sizes) {
  std::string text =
      "\n| points | surface and covariance | grows as N to the | whole fit | grows as N to the |\n";
  text += "|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    text += "| " + std::to_string(sizes[k]) + " |";
    for (const std::string name : {"ours/", "whole calibrated/"}) {
      const double us = times.median(name + std::to_string(sizes[k]));
      text += " " + duration(us, times.spread(name + std::to_string(sizes[k]))) + " | ";
      if (k > 0)
        text += exponent(us, times.median(name + std::to_string(sizes[k - 1])), sizes[k], sizes[k - 1]);
      text += " |";
    }
    text += "\n";
  }
  return text;
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// What a whole fit of many points takes beside them.
std::string memory(const Set& set) {
  const double before = peak_mb();
  benchmark::DoNotOptimize(
      whole(set.observations[0], FitMethod::calibrated, SurfaceRequest::elliptic_paraboloid));
  char text[160];
  std::snprintf(text, sizeof text, "\nA whole fit of %zu points takes %.0f bytes a point beside its input.\n",
                set.points, (peak_mb() - before) * 1048576.0 / static_cast<double>(set.points));
  return text;
}

}  // namespace
}  // namespace patchlab::bench

int main(int argc, char** argv) {
  using namespace patchlab::bench;
  std::string readme;
  std::vector<char*> arguments(argv, argv + argc);
  char interleaved[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleaved);
  for (std::size_t i = 1; i + 1 < arguments.size(); ++i) {
    if (std::strcmp(arguments[i], "--readme") != 0) continue;
    readme = arguments[i + 1];
    arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i),
                    arguments.begin() + static_cast<std::ptrdiff_t>(i + 2));
    break;
  }
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  std::vector<Set> sets, mixed;
  for (const auto& [points, draws] : {std::pair{150, 16}, {1500, 16}, {15000, 6}}) {
    const auto n = static_cast<std::size_t>(points);
    sets.push_back(make_set(n, patches(n, draws)));
    if (points <= 1500) mixed.push_back(make_set(n, mixed_patches(n)));
  }
  for (const Set& set : sets) {
    print_accuracy(set);
    add_all(set);
  }
  for (const Set& set : mixed) add_mixed(set);
  std::vector<Set> large;
  for (const int points : {150000, 1000000}) {
    const auto n = static_cast<std::size_t>(points);
    large.push_back(observed(n, patches(n, 1)));
  }
  const std::string memory_used = memory(large.back());
  for (const Set& set : large) add_for_scaling(set);
  Collector times;
  benchmark::RunSpecifiedBenchmarks(&times);
  const std::string text =
      table(times, sets) + scaling(times, {150, 1500, 15000, 150000, 1000000}) + memory_used;
  std::fputs(text.c_str(), stdout);
  if (!readme.empty() && !write_between_marks(readme, "fits", text)) return 1;
}
