// Fusion of real fits: one place scanned again and again, each scan fitted by itself, all fused, against the
// truth. What fits of one place have in common must not count as often as there are fits.
//
// Each expectation raises a false alarm with probability 1e-4 at most, were the seed drawn anew and the claim
// just met. PATCHLAB_FULL=1 in the environment runs 800 trials a type in place of 4, on all cores.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>

#include "engine/map/patch_map.h"
#include "tests/support/bands.h"
#include "tests/support/battery.h"
#include "tests/support/parallel.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

constexpr double false_alarm = 1e-4;
constexpr std::array<std::size_t, 3> scans = {2, 5, 20};

bool full_run() {
  const char* const value = std::getenv("PATCHLAB_FULL");
  return value != nullptr && std::string(value) == "1";
}

// NEES per degree of freedom after as many scans as `scans` says; none where the surface came out as another.
using Errors = std::array<std::optional<double>, scans.size()>;

Errors errors_of(const PatchTypeRow& type, std::uint64_t seed, int trial) {
  Random random(trial_seed(seed, type, trial));
  const ScenarioOptions options;
  const Scenario scenario = random_scenario(random, type, trial % 2 == 0, options);
  PatchMap map{"camera", {}};
  Errors out;
  for (std::size_t k = 1; k <= scans.back(); ++k) {
    const Result<FitResult> fit = fit_patch(observe(random, scenario, options), forced_fit(type));
    if (!fit) return {};
    const std::vector<Match> matches(map.patches.size(), Match{0, 0, {}, 1.0, false});
    map = merge(map, {{"scan"}, {std::to_string(k)}, {fit->patch}, {}}, matches).map;
    const Patch& fused = map.patches.front().patch;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (scans[i] != k || fused.type->surface != type.surface) continue;
      const Nees nees = surface_nees(fused, scenario.truth);
      out[i] = nees.value / nees.dof;
    }
  }
  return out;
}

// 0.9 to 1.1, and what chance adds to so many trials.
Band claimed(int trials, int dof) {
  const Band chance = nees_band(trials, dof, false_alarm);
  return {0.9 + chance.low - 1.0, 1.1 + chance.high - 1.0};
}

class FusedFits : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Table1, FusedFits, testing::Range(std::size_t{0}, patch_types().size()),
                         [](const auto& index) {
                           const PatchTypeRow& type = patch_types()[index.param];
                           return std::string(name(type.surface)) + "_" + std::string(name(type.boundary));
                         });

TEST_P(FusedFits, OfOnePlaceErrAsMuchAsTheirCovarianceSays) {
  const PatchTypeRow& type = patch_types()[GetParam()];
  const int trials = full_run() ? 800 : 4;
  const int threads = full_run() ? static_cast<int>(std::thread::hardware_concurrency()) : 1;
  const std::uint64_t seed = seed_of(current_test_name());
  const int dof = static_cast<int>(surface_error_names(type.surface).size());
  std::vector<Errors> all(static_cast<std::size_t>(trials));
  for_each_index(trials, threads,
                 [&](int i) { all[static_cast<std::size_t>(i)] = errors_of(type, seed, i); });
  for (std::size_t i = 0; i < scans.size(); ++i) {
    std::vector<double> nees;
    for (const Errors& errors : all) {
      if (errors[i]) nees.push_back(*errors[i]);
    }
    EXPECT_GE(nees.size(), all.size() * 9 / 10) << "other types took the place of this one";
    const Band band = claimed(static_cast<int>(nees.size()), dof);
    RecordProperty("nees_of_" + std::to_string(scans[i]) + "_scans", std::to_string(mean(nees)));
    EXPECT_TRUE(band.contains(mean(nees))) << mean(nees) << " after " << scans[i] << " scans is not in ["
                                           << band.low << ", " << band.high << "]";
  }
}

}  // namespace
}  // namespace patchlab::test
