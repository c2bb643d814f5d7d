// Whether the covariance is true: fits of fresh simulated scans against their truth, pooled over one type.
//
// Each expectation raises a false alarm with probability 1e-4 at most, were the seed drawn anew and the claim
// just met. PATCHLAB_FULL=1 in the environment runs 400 trials a type in place of 50, on all cores.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>

#include "tests/support/bands.h"
#include "tests/support/battery.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

constexpr double false_alarm = 1e-4;

bool full_run() {
  const char* const value = std::getenv("PATCHLAB_FULL");
  return value != nullptr && std::string(value) == "1";
}

BatteryRow pooled(const PatchTypeRow& type) {
  BatteryOptions options;
  options.trials = full_run() ? 400 : 50;
  options.threads = full_run() ? static_cast<int>(std::thread::hardware_concurrency()) : 1;
  options.seed = seed_of(current_test_name());
  return run_battery(type, options);
}

bool has_vertex_prior(SurfaceType surface) {
  return surface != SurfaceType::plane && surface != SurfaceType::sphere &&
         surface != SurfaceType::circular_cylinder;
}

bool has_two_curvatures(SurfaceType surface) {
  return surface == SurfaceType::elliptic_paraboloid || surface == SurfaceType::hyperbolic_paraboloid;
}

testing::AssertionResult lies_in(double value, const Band& band) {
  if (band.contains(value)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value << " is not in [" << band.low << ", " << band.high << "]";
}

Band widened(double low, double high, const Band& about_zero) {
  return {low + about_zero.low, high + about_zero.high};
}

void expect_convergence(const BatteryRow& row) {
  EXPECT_EQ(row.refused, 0);
  EXPECT_LE(row.trials - row.converged, row.trials / 200);  // 99.5 %
}

// Paraboloids know their vertex from a prior: what is claimed of them is 0.85 to 1.15.
void expect_true_surface(const BatteryRow& row) {
  EXPECT_TRUE(lies_in(mean(row.chi2_per_dof), mean_band(1.0, row.chi2_per_dof, false_alarm)));
  EXPECT_TRUE(lies_in(row.surface_covered, binomial_band(row.trials, 0.95, false_alarm)));
  Band nees = nees_band(row.trials, row.surface_dof, false_alarm);
  if (has_vertex_prior(row.type->surface)) nees = {std::min(nees.low, 0.85), std::max(nees.high, 1.15)};
  EXPECT_TRUE(lies_in(mean(row.surface_nees), nees));
}

void expect_true_bounds(const BatteryRow& row) {
  const Band nees = mean_band(0.0, row.full_nees, false_alarm),
             size = mean_band(0.0, row.size_ratio, false_alarm);
  EXPECT_TRUE(lies_in(mean(row.full_nees), widened(0.8, 1.3, nees)));
  const double bias = has_two_curvatures(row.type->surface) ? 0.05 : 0.02;
  EXPECT_TRUE(lies_in(mean(row.size_ratio), widened(1.0 - bias, 1.0 + bias, size)));
}

class Calibration : public testing::TestWithParam<std::size_t> {};

TEST_P(Calibration, ErrorsScatterAsTheCovarianceSays) {
  const PatchTypeRow& type = patch_types()[GetParam()];
  const BatteryRow row = pooled(type);
  expect_convergence(row);
  EXPECT_EQ(row.right_type, row.trials);
  expect_true_surface(row);
  expect_true_bounds(row);
}

INSTANTIATE_TEST_SUITE_P(TenTypes, Calibration, testing::Range(std::size_t{0}, patch_types().size()),
                         [](const auto& case_) {
                           const PatchTypeRow& type = patch_types()[case_.param];
                           return std::string(name(type.surface)) + "_" + std::string(name(type.boundary));
                         });

}  // namespace
}  // namespace patchlab::test
