// What is chosen where nothing is named, and what is kept by a refit.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/fit/fit_patch.h"
#include "engine/fit/shapes_about.h"
#include "engine/patch/hull.h"
#include "tests/support/battery.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using test::SeededRandom;

std::vector<Vector2d> points_of(Random& random, int count,
                                const std::function<bool(const Vector2d&)>& inside) {
  std::vector<Vector2d> points;
  while (static_cast<int>(points.size()) < count) {
    const Vector2d u(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    if (inside(u)) points.push_back(u);
  }
  return points;
}

TEST(Hull, LeastShapesHoldAllPointsAndTouchThem) {
  SeededRandom random;
  const auto disc = convex_hull(points_of(random, 20000, [](const Vector2d& u) { return u.norm() < 1.0; }));
  EXPECT_NEAR(least_circle_area(disc), std::numbers::pi, 0.01);
  EXPECT_NEAR(least_ellipse_area(disc), std::numbers::pi, 0.02);
  const auto square = convex_hull({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0.2, 0.3}});
  EXPECT_EQ(square.size(), 4u);
  EXPECT_NEAR(least_circle_area(square), 2.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(least_ellipse_area(square), 2.0 * std::numbers::pi, 0.01);
  const auto stretched = convex_hull({{-3, -1}, {3, -1}, {3, 1}, {-3, 1}});
  EXPECT_NEAR(least_ellipse_area(stretched), 6.0 * std::numbers::pi, 0.03);
  EXPECT_NEAR(least_circle_area(stretched), 10.0 * std::numbers::pi, 1e-9);
}

TEST(Hull, LeastCircleOfRandomPointsIsTheLeastOfAllPairsAndTriples) {
  SeededRandom random;
  for (int trial = 0; trial < 20; ++trial) {
    const auto hull = convex_hull(points_of(random, 12, [](const Vector2d&) { return true; }));
    const double radius = std::sqrt(least_circle_area(hull) / std::numbers::pi);
    double widest = 0.0;
    for (const Vector2d& a : hull) {
      for (const Vector2d& b : hull) widest = std::max(widest, (a - b).norm());
    }
    EXPECT_GE(radius, 0.5 * widest - 1e-12);
    EXPECT_LE(radius, widest / std::sqrt(3.0) + 1e-12);  // Jung
  }
}

// Of planes of each outline, 300 and 1500 points: how often the outline is recognised.
TEST(OutlineChoice, TakesTheTrueOne) {
  const std::uint64_t seed = test::seed_of(test::current_test_name());
  for (const PatchTypeRow& type : patch_types()) {
    if (type.surface != SurfaceType::plane) continue;
    int right = 0;
    constexpr int trials = 40;
    for (int trial = 0; trial < trials; ++trial) {
      Random random(test::trial_seed(seed, type, trial));
      test::ScenarioOptions scenario_options;
      test::Scenario scenario = test::random_scenario(random, type, true, scenario_options);
      FitOptions options;
      options.surface = SurfaceRequest::plane;
      const Result<FitResult> result = fit_patch(test::observe(random, scenario, scenario_options), options);
      ASSERT_TRUE(result);
      EXPECT_EQ(result->report.outlines.size(), 4u);
      if (result->patch.type->boundary == type.boundary) ++right;
    }
    EXPECT_GE(right, trials * 9 / 10) << name(type.boundary);
  }
}

// Refitting with points taken away and added gives what a fresh fit of the same type gives, with fewer
// iterations.
class RefitOfKept : public testing::TestWithParam<std::size_t> {};

TEST_P(RefitOfKept, EqualsTheFreshFit) {
  SeededRandom random;
  const PatchTypeRow& type = patch_types()[GetParam()];
  test::ScenarioOptions scenario_options;
  int fresh_iterations = 0, refit_iterations = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const test::Scenario scenario = test::random_scenario(random, type, trial % 2 == 0, scenario_options);
    const Observations all = test::observe(random, scenario, scenario_options);
    Observations part = all;
    part.points.resize(240);
    part.covariances.resize(240);
    const FitOptions options = test::forced_fit(type);
    const Result<FitResult> kept = fit_patch(part, options);
    const Result<FitResult> fresh = fit_patch(all, options);
    ASSERT_TRUE(kept && fresh);
    const Result<FitResult> again = refit_patch(kept->patch, all, FitOptions());
    ASSERT_TRUE(again);
    EXPECT_EQ(again->patch.type, fresh->patch.type);
    const test::Nees apart = test::surface_nees(again->patch, fresh->patch);
    EXPECT_LT(apart.value, 0.01 * 0.01 * apart.dof) << "trial " << trial;
    EXPECT_NEAR(again->report.chi2, fresh->report.chi2, 1e-2);
    fresh_iterations += fresh->report.iterations;
    refit_iterations += again->report.iterations;
  }
  if (type.surface != SurfaceType::plane) {  // planes are there at once either way
    EXPECT_LE(refit_iterations, fresh_iterations);
  }
}

INSTANTIATE_TEST_SUITE_P(TenTypes, RefitOfKept, testing::Range(std::size_t{0}, patch_types().size()),
                         [](const auto& case_) {
                           const PatchTypeRow& type = patch_types()[case_.param];
                           return std::string(name(type.surface)) + "_" + std::string(name(type.boundary));
                         });

}  // namespace
}  // namespace patchlab
