// What the fit answers where the points say little: a warning with its value, never a confident wrong answer.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "engine/fit/fit_patch.h"
#include "engine/patch/surface.h"
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

TEST(EdgeCase, FewPointsAreWarnedOf) {
  SeededRandom random;
  Field field;
  field.points = 12;
  const auto result = fit(observe(random, field), SurfaceRequest::plane);
  ASSERT_TRUE(result);
  const Finding* warning = find(result->report.warnings, "few_points");
  ASSERT_NE(warning, nullptr);
  EXPECT_EQ(warning->value, 12.0);
  EXPECT_EQ(warning->limit, 15.0);
}

TEST(EdgeCase, SemidefiniteCovariancesAreClampedAndNoted) {
  SeededRandom random;
  Observations observations = observe(random, {});
  const Vector3d ray = observations.points.front().normalized();
  for (Matrix3d& cov : observations.covariances) cov = 1e-6 * ray * ray.transpose();
  const auto result = fit(observations, SurfaceRequest::plane);
  ASSERT_TRUE(result);
  const Finding* note = find(result->report.warnings, "covariance_semidefinite");
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(note->value, 300.0);
  EXPECT_TRUE(result->patch.covariance->allFinite());
}

TEST(EdgeCase, AxisOfANearlyFlatCylinderIsSaidToBeUndetermined) {
  SeededRandom random;
  for (const SurfaceRequest surface :
       {SurfaceRequest::circular_cylinder, SurfaceRequest::cylindric_paraboloid}) {
    const auto result = fit(observe(random, {}), surface);
    ASSERT_TRUE(result);
    EXPECT_NE(find(result->report.warnings, "axis_undetermined"), nullptr);
  }
}

TEST(EdgeCase, AxisOfABentCylinderIsNot) {
  SeededRandom random;
  Field field;
  field.height = bowl(0.0, -6.0);
  const auto result = fit(observe(random, field), SurfaceRequest::circular_cylinder);
  ASSERT_TRUE(result);
  EXPECT_EQ(find(result->report.warnings, "axis_undetermined"), nullptr);
}

TEST(EdgeCase, NearlyFlatSphereIsSaidToBeFlat) {
  SeededRandom random;
  int warned = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const auto result = fit(observe(random, {}), SurfaceRequest::sphere);
    ASSERT_TRUE(result);
    if (const Finding* warning = find(result->report.warnings, "curvature_insignificant")) {
      EXPECT_LT(warning->value, 3.0);
      ++warned;
    }
  }
  EXPECT_GE(warned, 18);  // below 3 sigma in 99.7 % of all
}

TEST(EdgeCase, CurvatureBelowTheNoiseOfOnePointIsLowSignal) {
  SeededRandom random;
  Field field;
  field.sigma = 4e-3;
  field.height = bowl(0.3, 0.3);  // sag 1.5 mm at 0.1 m
  const auto result = fit(observe(random, field), SurfaceRequest::sphere);
  ASSERT_TRUE(result);
  const Finding* warning = find(result->report.warnings, "low_signal");
  ASSERT_NE(warning, nullptr);
  EXPECT_LT(warning->value, warning->limit);
}

TEST(EdgeCase, OutlineOfASphereEndsAtItsRadius) {
  SeededRandom random;
  Observations observations;
  observations.viewpoint = {0.0, 0.0, 2.0};
  for (int i = 0; i < 500; ++i) {  // nine tenths of a ball of 50 mm
    Vector3d n = random.unit3();
    while (n.z() < -0.8) n = random.unit3();
    observations.points.push_back(0.05 * n + 5e-4 * random.normal3());
    observations.covariances.push_back(2.5e-7 * Matrix3d::Identity());
  }
  const auto result = fit(observations, SurfaceRequest::sphere);
  ASSERT_TRUE(result);
  EXPECT_TRUE(validate(result->patch));
  EXPECT_LE(result->patch.parameters[0] * std::abs(result->patch.parameters[1]), 1.0);
}

TEST(EdgeCase, PointsAllRoundACanGiveItsRadius) {
  SeededRandom random;
  for (const double half_length : {0.03, 0.05, 0.2}) {
    Observations observations;
    const Vector3d axis = random.unit3(), across = axis.unitOrthogonal(), other = axis.cross(across);
    for (int i = 0; i < 800; ++i) {
      const double angle = random.uniform(0.0, 6.28318530717959);
      const Vector3d n = std::cos(angle) * across + std::sin(angle) * other;
      const double along = random.uniform(-half_length, half_length);
      observations.points.push_back(Vector3d(0.1, 0.0, 1.0) + along * axis + 0.05 * n +
                                    5e-4 * random.normal3());
      observations.covariances.push_back(2.5e-7 * Matrix3d::Identity());
    }
    for (const bool robust : {false, true}) {
      FitOptions options;
      options.surface = SurfaceRequest::circular_cylinder;
      options.robust = robust;
      const auto result = fit_patch(observations, options);
      ASSERT_TRUE(result) << result.error().message;
      EXPECT_NEAR(1.0 / std::abs(result->patch.parameters[2]), 0.05, 2e-4);
      EXPECT_NE(find(result->report.warnings, "bound_clamped"), nullptr);
      EXPECT_TRUE(validate(result->patch));
    }
  }
}

// Models of the noise are often wrong; half of the points still are of one surface, and the report says it.
TEST(EdgeCase, RobustFitHoldsWhereTheNoiseIsSaidTenTimesTooSmall) {
  SeededRandom random;
  constexpr double sigma = 1e-3, stated = 1e-4;
  for (const SurfaceRequest surface : {SurfaceRequest::plane, SurfaceRequest::sphere}) {
    const double kappa = surface == SurfaceRequest::plane ? 0.0 : 5.0;
    Observations observations;
    for (int i = 0; i < 1000; ++i) {
      const Vector2d u(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
      const double height =
          kappa * u.squaredNorm() / (1.0 + std::sqrt(1.0 - kappa * kappa * u.squaredNorm()));
      const double stray = i % 4 == 0 ? random.uniform(0.01, 0.1) : 0.0;
      observations.points.push_back(Vector3d(u.x(), u.y(), 1.0 - height - stray) + sigma * random.normal3());
      observations.covariances.push_back(stated * stated * Matrix3d::Identity());
    }
    FitOptions options;
    options.surface = surface;
    options.robust = true;
    const auto result = fit_patch(observations, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_GE(result->report.outliers.size(), 230u);
    EXPECT_LE(result->report.outliers.size(), 300u);
    const auto depth = ray_hit(result->patch, Vector3d::Zero(), Vector3d::UnitZ());
    ASSERT_TRUE(depth);
    EXPECT_NEAR(*depth, 1.0, 3e-4);
    EXPECT_FALSE(result->report.accepted);
    EXPECT_NE(find(result->report.reasons, "chi_square"), nullptr);
    EXPECT_NEAR(result->report.chi2 / result->report.dof, 100.0, 20.0);
  }
}

// A depth camera widens what it sees: its outermost points lie beside the surface.
TEST(EdgeCase, PointsAtDepthEdgesBoundTheSurfaceButDoNotBendIt) {
  SeededRandom random;
  Field field;
  field.height = bowl(-4.0, -4.0);
  Observations observations = observe(random, field);
  const auto inner = fit(observations, SurfaceRequest::sphere);
  observations.at_edge.assign(observations.size(), 0);
  const Vector3d ray = observations.points.front().normalized(), side = ray.unitOrthogonal();
  for (int i = 0; i < 40; ++i) {
    observations.points.push_back(Vector3d(0.02, -0.03, 1.02) + 0.15 * side + 1e-3 * random.normal3());
    observations.covariances.push_back(observations.covariances.front());
    observations.at_edge.push_back(1);
  }
  const auto both = fit(observations, SurfaceRequest::sphere);
  ASSERT_TRUE(inner);
  ASSERT_TRUE(both);
  EXPECT_NEAR(curvatures(both->patch)[0], curvatures(inner->patch)[0], 1e-6);
  EXPECT_NEAR(both->report.chi2, inner->report.chi2, 1e-3);
  EXPECT_EQ(both->report.dof, inner->report.dof);
  EXPECT_EQ(both->report.edge_points, 40u);
  EXPECT_GT(both->patch.parameters[0], 1.1 * inner->patch.parameters[0]);
}

TEST(EdgeCase, SelfOccludedBallIsSaidToBeSeenInPart) {
  SeededRandom random;
  Observations observations;
  observations.optical_axis = Vector3d::UnitZ();
  const Vector3d centre(0.0, 0.0, 1.0);
  while (observations.size() < 400) {  // all that a camera at the origin sees of a ball of 80 mm
    const Vector3d n = random.unit3(), q = centre + 0.08 * n;
    if (n.dot(q) > 0.0) continue;
    observations.points.push_back(q + 5e-4 * random.normal3());
    observations.covariances.push_back(2.5e-7 * Matrix3d::Identity());
  }
  const auto result = fit(observations, SurfaceRequest::sphere);
  ASSERT_TRUE(result);
  EXPECT_NE(find(result->report.warnings, "self_occluded"), nullptr);
  EXPECT_NEAR(-1.0 / result->patch.parameters[1], 0.08, 5e-4);
}

TEST(EdgeCase, GrazingPlaneIsAPlainResult) {
  SeededRandom random;
  Field field;
  field.tilt = 1.45;  // 83 degrees
  const auto result = fit(observe(random, field), SurfaceRequest::plane);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->report.accepted) << result->report.verdict;
}

TEST(EdgeCase, DirectionOfARoundOutlineIsUndetermined) {
  SeededRandom random;
  Field field;
  field.half = {0.1, 0.1};
  field.points = 3000;
  FitOptions options;
  options.surface = SurfaceRequest::plane;
  options.boundary = BoundaryRequest::ellipse;
  const auto round = fit_patch(observe(random, field), options);
  ASSERT_TRUE(round);
  EXPECT_NE(find(round->report.warnings, "orientation_undetermined"), nullptr);
  field.half = {0.1, 0.06};
  const auto longer = fit_patch(observe(random, field), options);
  ASSERT_TRUE(longer);
  EXPECT_EQ(find(longer->report.warnings, "orientation_undetermined"), nullptr);
}

TEST(EdgeCase, NormalAgainstZIsReportedAsSingular) {
  SeededRandom random;
  Field field;
  field.tilt = 0.02;
  FitOptions options;
  options.surface = SurfaceRequest::plane;
  options.boundary = BoundaryRequest::circle;  // rectangles have no r_xy
  const auto result = fit_patch(observe(random, field), options);
  ASSERT_TRUE(result);
  EXPECT_NE(find(result->report.warnings, "near_singular"), nullptr);
  EXPECT_LT(result->patch.covariance_local->diagonal().maxCoeff(), 1.0);  // never singular there
}

TEST(EdgeCase, WrongSurfaceIsNotAcceptedAndItsSigmaIsNotInflated) {
  SeededRandom random;
  Field field;
  field.height = bowl(6.0, -6.0);
  const Observations observations = observe(random, field);
  const auto right = fit(observations, SurfaceRequest::hyperbolic_paraboloid);
  const auto wrong = fit(observations, SurfaceRequest::plane);
  ASSERT_TRUE(right && wrong);
  EXPECT_EQ(find(right->report.reasons, "chi_square"), nullptr) << right->report.verdict;
  EXPECT_FALSE(wrong->report.accepted);
  EXPECT_NE(find(wrong->report.reasons, "chi_square"), nullptr);
  field.height = bowl(0.0, 0.0);
  const auto flat = fit(observe(random, field), SurfaceRequest::plane);
  ASSERT_TRUE(flat);
  const auto height_variance = [](const FitResult& result) {
    const PatchMatrix& cov = *result.patch.covariance_local;
    return cov(cov.rows() - 1, cov.cols() - 1);
  };
  EXPECT_NEAR(height_variance(*wrong) / height_variance(*flat), 1.0, 0.2);
}

TEST(EdgeCase, TypeThatTheCurvaturesDenyIsNotAccepted) {
  SeededRandom random;
  Field field;
  field.height = bowl(6.0, -6.0);
  const auto saddle = fit(observe(random, field), SurfaceRequest::elliptic_paraboloid);
  ASSERT_TRUE(saddle);
  EXPECT_EQ(saddle->patch.type->surface, SurfaceType::hyperbolic_paraboloid);
  EXPECT_FALSE(saddle->report.accepted);
  EXPECT_NE(find(saddle->report.reasons, "type"), nullptr);
  field.height = bowl(5.0, 8.0);
  const auto dish = fit(observe(random, field), SurfaceRequest::hyperbolic_paraboloid);
  ASSERT_TRUE(dish);
  EXPECT_EQ(dish->patch.type->surface, SurfaceType::elliptic_paraboloid);
  EXPECT_NE(find(dish->report.reasons, "type"), nullptr);
}

TEST(EdgeCase, LongPipeIsAccepted) {
  SeededRandom random;
  Field field;
  field.half = {0.5, 0.03};
  const double radius = 0.05;
  field.height = [=](const Vector2d& u) { return std::sqrt(radius * radius - u.y() * u.y()) - radius; };
  const auto result = fit(observe(random, field), SurfaceRequest::circular_cylinder);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->report.accepted) << result->report.verdict;
}

}  // namespace
}  // namespace patchlab
