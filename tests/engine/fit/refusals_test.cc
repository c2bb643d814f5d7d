// What no fit can answer is an error that says why.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

#include "engine/fit/fit_patch.h"
#include "tests/engine/fit/height_field.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using test::bowl;
using test::Field;
using test::find;
using test::fit;
using test::observe;
using test::SeededRandom;

void expect_refused(const Result<FitResult>& result, const std::string& says) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::no_finite_fit);
  EXPECT_NE(result.error().message.find(says), std::string::npos) << result.error().message;
}

TEST(EdgeCase, FewerPointsThanTheSurfaceNeedsAreRefusedAndEnoughAreNot) {
  SeededRandom random;
  const std::pair<SurfaceRequest, std::size_t> least[] = {{SurfaceRequest::plane, 4},
                                                          {SurfaceRequest::sphere, 5},
                                                          {SurfaceRequest::circular_paraboloid, 5},
                                                          {SurfaceRequest::circular_cylinder, 6},
                                                          {SurfaceRequest::cylindric_paraboloid, 6},
                                                          {SurfaceRequest::elliptic_paraboloid, 7},
                                                          {SurfaceRequest::hyperbolic_paraboloid, 7},
                                                          {SurfaceRequest::automatic, 4}};
  for (const auto& [surface, needed] : least) {
    Field field;
    field.points = needed - 1;
    expect_refused(fit(observe(random, field), surface), "Too few points");
  }
}

TEST(EdgeCase, NoPointsAtAllAreRefused) {
  expect_refused(fit({}, SurfaceRequest::automatic), "Too few points: 0");
}

TEST(EdgeCase, CoincidentPointsAreRefused) {
  SeededRandom random;
  Field field;
  field.half = {0.0, 0.0};
  for (const double sigma : {1e-3, 1e-9}) {
    field.sigma = sigma;
    expect_refused(fit(observe(random, field), SurfaceRequest::sphere), "coincide");
  }
}

TEST(EdgeCase, CollinearPointsAreRefused) {
  SeededRandom random;
  Field field;
  field.half.y() = 0.0;
  for (const double sigma : {1e-3, 1e-9}) {
    field.sigma = sigma;
    for (const SurfaceRequest surface : {SurfaceRequest::plane, SurfaceRequest::circular_cylinder}) {
      expect_refused(fit(observe(random, field), surface), "line");
    }
  }
}

TEST(EdgeCase, BadCovariancesAreRefusedByRow) {
  SeededRandom random;
  const Observations good = observe(random, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<Matrix3d, const char*> bad[] = {
      {Vector3d(1e-6, 1e-6, -1e-8).asDiagonal(), "not positive semi-definite"},
      {Matrix3d::Zero(), "not positive semi-definite"},
      {(Matrix3d() << 1e-6, 1e-7, 0, 0, 1e-6, 0, 0, 0, 1e-6).finished(), "not symmetric"},
      {Matrix3d::Constant(nan), "not finite"}};
  for (const auto& [cov, says] : bad) {
    Observations observations = good;
    observations.covariances[17] = cov;
    const auto result = fit(observations, SurfaceRequest::plane);
    expect_refused(result, says);
    expect_refused(result, "Point 17");
  }
  Observations observations = good;
  observations.points[5].y() = nan;
  expect_refused(fit(observations, SurfaceRequest::plane), "Point 5");
}

TEST(EdgeCase, ContainmentOutsideItsRangeIsWrongUsage) {
  SeededRandom random;
  const Observations observations = observe(random, {});
  for (const double gamma : {0.0, -0.5, 1.01, std::numeric_limits<double>::quiet_NaN()}) {
    FitOptions options;
    options.containment = gamma;
    const auto result = fit_patch(observations, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::usage);
  }
}

TEST(FitPatch, ThatIsToldToStopTakesNoFurtherSteps) {
  SeededRandom random;
  const Observations observations = observe(random, {.height = bowl(-4.0, -5.0)});
  int asked = 0;
  ASSERT_TRUE(fit_patch(observations, {}, [&asked](double) { return ++asked > 0; }));
  const int in_full = asked;
  asked = 0;
  const Result<FitResult> stopped = fit_patch(observations, {}, [&asked](double) { return ++asked < 8; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  EXPECT_LT(asked, in_full / 2) << "each fit that was still to come asks once";
}

}  // namespace
}  // namespace patchlab
