#include "tests/support/battery.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/chi_square.h"

namespace patchlab::test {
namespace {

void record_sizes(const Patch& fitted, const Patch& truth, BatteryRow& row) {
  if (fitted.type->boundary == BoundaryType::convex_quad) return;  // its labels are matched by NEES only
  const BoundaryVector d = boundary(fitted).d, d_true = boundary(truth).d;
  for (int i = 0; i < d.size(); ++i) row.size_ratio.push_back(d[i] / d_true[i]);
}

void record(const FitResult& fit, const Scenario& scenario, BatteryRow& row) {
  const FitReport& report = fit.report;
  row.converged += report.converged ? 1 : 0;
  row.iterations.push_back(report.iterations);
  row.chi2_per_dof.push_back(report.chi2 / report.dof);
  if (fit.patch.type->surface != scenario.truth.type->surface) return;
  ++row.right_type;
  if (fit.patch.type != scenario.truth.type) return;
  const Nees surface = surface_nees(fit.patch, scenario.truth), full = full_nees(fit.patch, scenario.truth);
  row.surface_nees.push_back(surface.value / surface.dof);
  row.full_nees.push_back(full.value / full.dof);
  row.surface_covered += surface.value < chi_square_quantile(0.95, surface.dof) ? 1 : 0;
  row.full_covered += full.value < chi_square_quantile(0.95, full.dof) ? 1 : 0;
  row.surface_errors.push_back(surface.errors);
  row.surface_sigmas.push_back(surface.sigmas);
  record_sizes(fit.patch, scenario.truth, row);
}

}  // namespace

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
  Random random(options.seed);
  for (int trial = 0; trial < options.trials; ++trial) {
    const Scenario scenario = random_scenario(random, type, trial % 2 == 0, options.scenario);
    const Observations observations = observe(random, scenario, options.scenario);
    ++row.trials;
    const Result<FitResult> fit = fit_patch(observations, fit_options);
    if (fit) {
      record(*fit, scenario, row);
    } else {
      ++row.refused;
    }
  }
  return row;
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
