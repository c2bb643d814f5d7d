// The descriptions of one patch: each names the same points, and the conventions choose one of them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/patch/patch.h"
#include "tests/engine/patch/example_patches.h"
#include "tests/support/numeric_jacobian.h"

namespace patchlab::test {
namespace {

using std::numbers::pi;

bool swappable(const PatchTypeRow& type) { return !type.revolute() && type.curvature_size != 1; }

class PatchSymmetry : public testing::TestWithParam<PatchCase> {};
class AxisSwap : public PatchSymmetry {};
class RevoluteSymmetry : public PatchSymmetry {};
INSTANTIATE_TEST_SUITE_P(Table1, PatchSymmetry, testing::ValuesIn(all_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Table1, AxisSwap, testing::ValuesIn(cases_where(swappable)), case_name);
INSTANTIATE_TEST_SUITE_P(
    Table1, RevoluteSymmetry,
    testing::ValuesIn(cases_where([](const PatchTypeRow& type) { return type.revolute(); })), case_name);

// Points on, inside and just outside of a are so for b.
void expect_same_points(Random& random, const Patch& a, const Patch& b) {
  for (int i = 0; i < 30; ++i) {
    const Vector3d q = world_point(a, random_u(random, a));
    EXPECT_NEAR(implicit(apply_inverse(world_from_patch(b), q), k3(b)), 0.0, 1e-14);
    EXPECT_TRUE(contains(b, q));
  }
  for (const Vector2d& u : outline(boundary(a), 12)) {
    EXPECT_TRUE(contains(b, world_point(a, 0.999 * u)));
    EXPECT_FALSE(contains(b, world_point(a, 1.001 * u)));
  }
}

// The covariances of change(patch) are those that its numeric derivative gives.
void expect_covariances_carried(const Patch& patch, const std::function<Patch(const Patch&)>& change) {
  const Patch changed = change(patch);
  const VectorXd zero = VectorXd::Zero(patch.type->size());
  const auto chart = [&](const VectorXd& e) -> VectorXd {
    return chart_difference(changed, change(moved_in_chart(patch, e)));
  };
  const auto parameters = [&](const VectorXd& e) -> VectorXd {
    return change(moved_in_chart(patch, e)).parameters;
  };
  const PatchMatrix J_chart = numeric_jacobian(chart, zero, 1e-3);
  const PatchMatrix J_parameters = numeric_jacobian(parameters, zero, 1e-4);
  EXPECT_TRUE(same_covariance(*changed.covariance_local, carried(J_chart, *patch.covariance_local), 1e-8));
  EXPECT_TRUE(same_covariance(*changed.covariance, carried(J_parameters, *patch.covariance_local), 1e-6));
}

TEST_P(PatchSymmetry, FlippingTheNormalKeepsThePoints) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam()), flipped = flip_normal(patch);
  expect_same_points(random, patch, flipped);
  EXPECT_LT((axes(flipped).col(2) + axes(patch).col(2)).norm(), 1e-14);
  EXPECT_EQ(curvatures(flipped), -curvatures(patch));
}

TEST_P(PatchSymmetry, FlippingTwiceIsNothing) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  EXPECT_TRUE(same_patch(flip_normal(flip_normal(patch)), patch));
}

TEST_P(PatchSymmetry, FlippingCarriesTheCovariances) {
  SeededRandom random;
  expect_covariances_carried(random_patch(random, GetParam(), 1.3), flip_normal);
}

TEST_P(PatchSymmetry, HalfTurnKeepsThePointsAndTheNormal) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam()), turned = half_turn(patch);
  expect_same_points(random, patch, turned);
  EXPECT_LT((axes(turned).col(2) - axes(patch).col(2)).norm(), 1e-14);
  if (!patch.type->revolute()) {
    EXPECT_LT((axes(turned).col(0) + axes(patch).col(0)).norm(), 1e-14);
  }
}

TEST_P(PatchSymmetry, TwoHalfTurnsAreNothing) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  EXPECT_TRUE(same_patch(half_turn(half_turn(patch)), patch));
}

TEST_P(PatchSymmetry, HalfTurnCarriesTheCovariances) {
  SeededRandom random;
  expect_covariances_carried(random_patch(random, GetParam(), 1.3), half_turn);
}

TEST_P(RevoluteSymmetry, HalfTurnIsNothing) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  EXPECT_TRUE(same_patch(half_turn(patch), patch));
}

TEST_P(AxisSwap, KeepsThePoints) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam()), swapped = swap_axes(patch);
  expect_same_points(random, patch, swapped);
  EXPECT_LT((axes(swapped).col(0) - axes(patch).col(1)).norm(), 1e-14);
  EXPECT_LT((axes(swapped).col(1) + axes(patch).col(0)).norm(), 1e-14);
}

TEST_P(AxisSwap, FourTimesIsNothingAndTwiceIsAHalfTurn) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam()), twice = swap_axes(swap_axes(patch));
  EXPECT_TRUE(same_patch(twice, half_turn(patch)));
  EXPECT_TRUE(same_patch(swap_axes(swap_axes(twice)), patch));
}

TEST_P(AxisSwap, CarriesTheCovariances) {
  SeededRandom random;
  expect_covariances_carried(random_patch(random, GetParam(), 1.3), swap_axes);
}

TEST_P(PatchSymmetry, ACovarianceOfTheParametersAloneIsCarriedToo) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam(), 1.3);
  Patch without_local = patch;
  without_local.covariance_local.reset();
  const Patch flipped = flip_normal(without_local);
  EXPECT_TRUE(same_covariance(*flipped.covariance_local, *flip_normal(patch).covariance_local, 1e-12));
  EXPECT_FALSE(
      flip_normal(make_patch(*patch.type, boundary(patch), curvatures(patch), axes(patch), centre(patch)))
          .covariance);
}

TEST_P(PatchSymmetry, ConventionalKeepsThePointsAndFollowsTheConventions) {
  SeededRandom random;
  for (int i = 0; i < 10; ++i) {
    const Patch patch = random_patch(random, GetParam());
    const Vector3d viewpoint = 3.0 * random.normal3();
    const Patch chosen = conventional(patch, viewpoint);
    expect_same_points(random, patch, chosen);
    EXPECT_GT(axes(chosen).col(2).dot(viewpoint - centre(chosen)), 0.0);
    const VectorXd k = curvatures(chosen), d = boundary(chosen).d;
    if (k.size() == 2) {
      EXPECT_LE(std::abs(k[0]), std::abs(k[1]));
    }
    if (chosen.type->surface == SurfaceType::plane && d.size() == 2) {
      EXPECT_GE(d[0], d[1]);
    }
    if (d.size() == 5) {
      EXPECT_LE(d[4], pi / 4);
    }
    EXPECT_LE(world_from_patch(chosen).r.norm(), world_from_patch(half_turn(chosen)).r.norm() + 1e-12);
    EXPECT_TRUE(validate(chosen));
  }
}

TEST_P(PatchSymmetry, EveryDescriptionHasTheSameConventionalOne) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Vector3d viewpoint = 3.0 * random.normal3();
  const Patch chosen = conventional(patch, viewpoint);
  EXPECT_TRUE(same_patch(conventional(chosen, viewpoint), chosen));
  EXPECT_TRUE(same_patch(conventional(half_turn(patch), viewpoint), chosen));
  EXPECT_TRUE(same_patch(conventional(flip_normal(patch), viewpoint), chosen));
  if (swappable(*patch.type)) {
    EXPECT_TRUE(same_patch(conventional(swap_axes(patch), viewpoint), chosen));
  }
}

TEST_P(PatchSymmetry, ConventionalKeepsTheNormalWhereNoViewpointIsGiven) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  EXPECT_LT((axes(conventional(patch)).col(2) - axes(patch).col(2)).norm(), 1e-14);
}

TEST(Conventional, EqualOppositeCurvaturesPutTheNegativeOneFirst) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::hyperbolic_paraboloid, BoundaryType::ellipse);
  const Patch patch = make_patch(type, {BoundaryType::ellipse, Vector2d(0.1, 0.2)}, Vector2d(3, -3),
                                 Matrix3d::Identity(), Vector3d::Zero());
  EXPECT_EQ(curvatures(conventional(patch)), VectorXd(Vector2d(-3, 3)));
  EXPECT_EQ(boundary(conventional(patch)).d, BoundaryVector(Vector2d(0.2, 0.1)));
}

TEST(Conventional, ATieOfHalfTurnsIsDecidedByTheLargerComponents) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::rectangle);
  const auto at = [&](const Vector3d& r) {
    return world_from_patch(conventional(make_patch(type, {BoundaryType::rectangle, Vector2d(0.2, 0.1)},
                                                    VectorXd(), exp_map(r), Vector3d::Zero())))
        .r;
  };
  EXPECT_LT((at({0, 0, -pi / 2}) - Vector3d(0, 0, pi / 2)).norm(), 1e-14);
  EXPECT_LT((at({0, 0, pi / 2}) - Vector3d(0, 0, pi / 2)).norm(), 1e-14);
}

TEST(Conventional, AViewpointInThePlaneOfThePatchTurnsItsNormalToThePositiveSide) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::circle);
  const Patch patch = make_patch(type, {BoundaryType::circle, BoundaryVector::Constant(1, 0.1)}, VectorXd(),
                                 Vector3d(1, -1, -1).asDiagonal(), Vector3d::Zero());
  EXPECT_LT((axes(conventional(patch, Vector3d(1, 0, 0))).col(2) - Vector3d::UnitZ()).norm(), 1e-14);
}

TEST(Conventional, LongOrientationVectorsBecomeCanonical) {
  SeededRandom random;
  Patch patch = random_patch(random, all_cases()[0], 1.0);
  const Patch expected = conventional(patch);
  const int at = patch.type->rotation_at();
  const Vector3d r = patch.parameters.segment<3>(at);
  patch.parameters.segment<3>(at) = r * (1.0 + 2.0 * pi / r.norm());
  EXPECT_TRUE(same_patch(conventional(patch), expected));
  EXPECT_LE(world_from_patch(conventional(patch)).r.norm(), pi);
}

}  // namespace
}  // namespace patchlab::test
