// The Monte Carlo battery: many fits of fresh scenarios against their truth, one row a patch type.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/fit/fit_patch.h"
#include "tests/support/nees.h"
#include "tests/support/scenario.h"

namespace patchlab::test {

struct BatteryOptions {
  int trials = 100;
  FitMethod method = FitMethod::calibrated;
  bool robust = false;
  bool forced = true;  // the type is named; otherwise paraboloid: step 3 chooses among the five
  ScenarioOptions scenario;
  std::uint64_t seed = 1;
  int threads = 1;  // changes no number: every trial draws from a seed of its own
};

// The seed of one trial of one type.
std::uint64_t trial_seed(std::uint64_t seed, const PatchTypeRow& type, int trial);

// What the trials of one type gave.
struct BatteryRow {
  const PatchTypeRow* type = nullptr;
  int trials = 0, converged = 0, refused = 0, right_type = 0;
  std::array<int, 7> chosen{};                                // fits of each SurfaceType
  std::vector<double> chi2_per_dof, surface_nees, full_nees;  // NEES per degree of freedom
  int surface_dof = 0, full_dof = 0;
  int surface_covered = 0, full_covered = 0;  // inside the 95 % ellipsoid
  std::vector<double> iterations;
  std::vector<double> size_ratio;  // d / d_true, every length among the d
  std::vector<Eigen::VectorXd> surface_errors, surface_sigmas;
};

BatteryRow run_battery(const PatchTypeRow& type, const BatteryOptions& options);

// Trials whose NEES lies inside the ellipsoid of a probability; `per_dof` as in a row.
int inside(const std::vector<double>& per_dof, int dof, double probability);

// The request that forces a type by name.
FitOptions forced_fit(const PatchTypeRow& type);

double mean(const std::vector<double>& values);
double median(std::vector<double> values);
double deviation(const std::vector<double>& values);

}  // namespace patchlab::test
