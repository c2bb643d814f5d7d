#include "tests/support/battery.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/chi_square.h"
#include "tests/support/parallel.h"

namespace patchlab::test {
namespace {

struct Trial {
  Scenario scenario;
  Result<FitResult> fit = Error{ErrorCode::cancelled, "Not tried."};
};

Trial run_trial(const PatchTypeRow& type, const BatteryOptions& options, const FitOptions& fit_options,
                int number) {
  Random random(trial_seed(options.seed, type, number));
  Trial trial;
  trial.scenario = random_scenario(random, type, number % 2 == 0, options.scenario);
  trial.fit = fit_patch(observe(random, trial.scenario, options.scenario), fit_options);
  return trial;
}

void record_sizes(const Patch& fitted, const Patch& truth, BatteryRow& row) {
  const Patch near = nearest_description(fitted, truth);
  const BoundaryVector d = boundary(fitted).d, d_true = boundary(near).d;
  const bool quad = fitted.type->boundary == BoundaryType::convex_quad;  // whose last d is an angle
  for (int i = 0; i < d.size() - (quad ? 1 : 0); ++i) row.size_ratio.push_back(d[i] / d_true[i]);
}

void record(const FitResult& fit, const Scenario& scenario, BatteryRow& row) {
  const FitReport& report = fit.report;
  row.converged += report.converged ? 1 : 0;
  row.iterations.push_back(report.iterations);
  row.chi2_per_dof.push_back(report.chi2 / report.dof);
  ++row.chosen[static_cast<std::size_t>(fit.patch.type->surface)];
  if (fit.patch.type != scenario.truth.type) return;
  ++row.right_type;
  const Nees surface = surface_nees(fit.patch, scenario.truth), full = full_nees(fit.patch, scenario.truth);
  row.surface_dof = surface.dof;
  row.full_dof = full.dof;
  row.surface_nees.push_back(surface.value / surface.dof);
  row.full_nees.push_back(full.value / full.dof);
  row.surface_errors.push_back(surface.errors);
  row.surface_sigmas.push_back(surface.sigmas);
  record_sizes(fit.patch, scenario.truth, row);
}

// The finaliser of SplitMix64: neighbouring numbers give unrelated seeds.
std::uint64_t scattered(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

std::uint64_t trial_seed(std::uint64_t seed, const PatchTypeRow& type, int trial) {
  const auto row = static_cast<std::uint64_t>(&type - patch_types().data());
  return scattered(scattered(scattered(seed) + row + 1) + static_cast<std::uint64_t>(trial) + 1);
}

FitOptions forced_fit(const PatchTypeRow& type) {
  FitOptions options;
  options.surface = *surface_request_from_name(name(type.surface));
  options.boundary = *boundary_request_from_name(name(type.boundary));
  return options;
}

BatteryRow run_battery(const PatchTypeRow& type, const BatteryOptions& options) {
  BatteryRow row;
  row.type = &type;
  FitOptions fit_options = forced_fit(type);
  fit_options.method = options.method;
  fit_options.robust = options.robust;
  if (!options.forced) fit_options.surface = SurfaceRequest::paraboloid;
  std::vector<Trial> trials(static_cast<std::size_t>(options.trials));
  for_each_index(options.trials, options.threads, [&](int i) {
    trials[static_cast<std::size_t>(i)] = run_trial(type, options, fit_options, i);
  });
  for (const Trial& trial : trials) {
    ++row.trials;
    if (trial.fit) {
      record(*trial.fit, trial.scenario, row);
    } else {
      ++row.refused;
    }
  }
  row.surface_covered = inside(row.surface_nees, row.surface_dof, 0.95);
  row.full_covered = inside(row.full_nees, row.full_dof, 0.95);
  return row;
}

int inside(const std::vector<double>& per_dof, int dof, double probability) {
  if (per_dof.empty()) return 0;
  const double limit = chi_square_quantile(probability, dof) / dof;
  return static_cast<int>(
      std::count_if(per_dof.begin(), per_dof.end(), [&](double value) { return value < limit; }));
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double deviation(const std::vector<double>& values) {
  const double m = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - m) * (value - m);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace patchlab::test
