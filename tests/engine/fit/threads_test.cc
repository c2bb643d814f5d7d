// A fit of so many points that threads share it: the same bytes on one of them.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "engine/fit/fit_patch.h"
#include "engine/fit/sample_rows.h"
#include "tests/support/battery.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

FitResult fit_on(int threads, const Observations& observations, const FitOptions& options) {
  Result<FitResult> result = Error{ErrorCode::usage, "not run"};
  tbb::task_arena(threads).execute([&] { result = fit_patch(observations, options); });
  EXPECT_TRUE(result) << result.error().message;
  return *result;
}

TEST(Threads, AFitIsTheSameByteForByteOnOneOfThemAndOnMany) {
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  test::SeededRandom random;
  test::ScenarioOptions scenario;
  scenario.points = 12000;
  for (const PatchTypeRow& type : patch_types()) {
    const Observations observations =
        test::observe(random, test::random_scenario(random, type, true, scenario), scenario);
    for (const bool robust : {false, true}) {
      FitOptions options;
      options.robust = robust;
      options.surface = *surface_request_from_name(name(type.surface));
      options.boundary = *boundary_request_from_name(name(type.boundary));
      const FitResult one = fit_on(1, observations, options), many = fit_on(4, observations, options);
      EXPECT_EQ(one.patch.parameters, many.patch.parameters) << name(type.surface);
      EXPECT_EQ(*one.patch.covariance_local, *many.patch.covariance_local) << name(type.surface);
      EXPECT_EQ(one.report.residuals, many.report.residuals);
      EXPECT_EQ(one.report.residual_rms, many.report.residual_rms);
      EXPECT_EQ(one.report.outliers, many.report.outliers);
    }
  }
}

// The start of 14,465 points leaves out all blocks of the last part.
TEST(Threads, APartThatAddsNothingAddsNothing) {
  test::SeededRandom random;
  test::ScenarioOptions scenario;
  scenario.points = 14465;
  const PatchTypeRow& type = *find_patch_type(SurfaceType::elliptic_paraboloid, BoundaryType::ellipse);
  const Observations observations =
      test::observe(random, test::random_scenario(random, type, true, scenario), scenario);
  FitOptions options;
  options.surface = SurfaceRequest::elliptic_paraboloid;
  const FitResult one = fit_on(1, observations, options);
  fit_on(1, test::observe(random, test::random_scenario(random, type, true, scenario), scenario), options);
  const FitResult again = fit_on(2, observations, options);
  EXPECT_EQ(one.patch.parameters, again.patch.parameters);
  EXPECT_EQ(one.report.iterations, again.report.iterations);
}

TEST(Threads, SumsOfNothingAreZero) {
  for (const int size : {3, 6, 8}) {
    const NormalEquations none = normal_equations(RowSums{}, size);
    EXPECT_TRUE(none.A.isZero(0.0) && none.A.rows() == size);
    EXPECT_TRUE(none.b.isZero(0.0));
    EXPECT_EQ(none.cost, 0.0);
  }
}

}  // namespace
}  // namespace patchlab
