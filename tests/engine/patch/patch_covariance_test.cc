// The two covariances of a patch, and how they travel between frames.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/patch/patch.h"
#include "engine/pose/chain.h"
#include "tests/engine/patch/example_patches.h"
#include "tests/support/monte_carlo.h"
#include "tests/support/numeric_jacobian.h"

namespace patchlab::test {
namespace {

using std::numbers::pi;

class PatchCovariance : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, PatchCovariance, testing::ValuesIn(all_cases()), case_name);

UncertainPose random_pose(Random& random, double length) {
  Vector6d sigma;
  sigma << 0.01, 0.01, 0.01, 0.002, 0.002, 0.002;
  const Matrix6d cov = sigma.asDiagonal() * Matrix6d(random_covariance(random, 6, 1.0)) * sigma.asDiagonal();
  return {{length * random.unit3(), random.normal3()}, cov};
}

TEST_P(PatchCovariance, ChartAndParametersAreJoinedByTheirJacobians) {
  SeededRandom random;
  for (const double length : {0.0, 1e-8, 0.7, 2.8}) {
    const Patch patch = random_patch(random, GetParam(), length);
    const auto parameters = [&](const VectorXd& e) -> VectorXd {
      return moved_in_chart(patch, e).parameters;
    };
    EXPECT_TRUE(jacobian_matches(J_parameters_local(patch), parameters, VectorXd::Zero(patch.type->size()),
                                 {.step = 1e-4, .tolerance = 1e-9}));
    const PatchMatrix product = J_parameters_local(patch) * J_local_parameters(patch);
    EXPECT_LT((product - PatchMatrix::Identity(product.rows(), product.cols())).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST_P(PatchCovariance, OfTheParametersFollowsFromTheLocalOne) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  EXPECT_TRUE(
      same_covariance(*patch.covariance, carried(J_parameters_local(patch), *patch.covariance_local), 1e-12));
  EXPECT_EQ(*patch.covariance, patch.covariance->transpose());
}

TEST_P(PatchCovariance, OfTheChartFollowsFromTheParameters) {
  SeededRandom random;
  Patch patch = random_patch(random, GetParam(), 2.0);
  const PatchMatrix expected = *patch.covariance_local;
  patch.covariance_local.reset();
  EXPECT_TRUE(same_covariance(*local_covariance(patch), expected, 1e-12));
  patch.covariance.reset();
  EXPECT_FALSE(local_covariance(patch));
}

TEST_P(PatchCovariance, IsTakenInTheAxesThatItIsGivenIn) {
  SeededRandom random;
  const PatchTypeRow& type = *GetParam().type;
  const Patch patch = random_patch(random, GetParam(), 1.0);
  const Matrix3d R = exp_map(2.0 * random.unit3());  // spun about z against R([r_xy; 0])
  const Patch made =
      make_patch(type, boundary(patch), curvatures(patch), R, centre(patch), patch.covariance_local);
  const auto change = [&](const VectorXd& e) -> VectorXd {
    Vector3d w = Vector3d::Zero();
    w.head(type.rotation_size) = e.segment(type.rotation_at(), type.rotation_size);
    const VectorXd d = boundary(patch).d + e.head(type.boundary_size);
    const VectorXd kappa = curvatures(patch) + e.segment(type.curvature_at(), type.curvature_size);
    const Vector3d c = centre(patch) + R * e.tail<3>();
    return chart_difference(made, make_patch(type, {type.boundary, d}, kappa, R * exp_map(w), c));
  };
  const PatchMatrix J = numeric_jacobian(change, VectorXd::Zero(type.size()), 1e-3);
  EXPECT_TRUE(same_covariance(*made.covariance_local, carried(J, *patch.covariance_local), 1e-8));
}

TEST_P(PatchCovariance, MovingThereAndBackIsNothing) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Pose pose = random_pose(random, 2.0).pose;
  const Patch back = transform(inverse(pose), transform(pose, patch));
  EXPECT_TRUE(same_patch(back, patch));
}

TEST_P(PatchCovariance, MovingMovesThePoints) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Pose pose = random_pose(random, 2.0).pose;
  const Patch moved = transform(pose, patch);
  for (int i = 0; i < 30; ++i) {
    const Vector3d q = apply(pose, world_point(patch, random_u(random, patch)));
    EXPECT_NEAR(implicit(apply_inverse(world_from_patch(moved), q), k3(moved)), 0.0, 1e-13);
    EXPECT_TRUE(contains(moved, q));
  }
  EXPECT_NEAR(surface_area(moved), surface_area(patch), 1e-15);
}

TEST_P(PatchCovariance, MovingByAKnownPoseAddsNothing) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const UncertainPose known = {random_pose(random, 2.0).pose, Matrix6d::Zero()};
  EXPECT_TRUE(same_patch(transform(known, patch), transform(known.pose, patch)));
}

// Of the patch's chart and the pose's (r, t) together.
TEST_P(PatchCovariance, MovingByAnUncertainPoseAgreesWithDifferencesAndSampling) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const UncertainPose pose = random_pose(random, 1.5);
  const Patch moved = transform(pose, patch);
  const int n = patch.type->size();
  const auto change = [&](const VectorXd& e) -> VectorXd {
    const Pose moved_pose = {pose.pose.r + e.segment<3>(n), pose.pose.t + e.tail<3>()};
    return chart_difference(moved, transform(moved_pose, moved_in_chart(patch, e.head(n))));
  };
  Eigen::MatrixXd cov = Eigen::MatrixXd::Zero(n + 6, n + 6);
  cov.topLeftCorner(n, n) = *patch.covariance_local;
  cov.bottomRightCorner<6, 6>() = pose.covariance;
  const Eigen::MatrixXd J = numeric_jacobian(change, VectorXd::Zero(n + 6), 1e-3);
  EXPECT_TRUE(same_covariance(*moved.covariance_local, PatchMatrix(J * cov * J.transpose()), 1e-8));
  constexpr int count = 2000;
  EXPECT_TRUE(
      covariance_agrees(*moved.covariance_local, sampled_covariance(random, cov, count, change), count));
}

// Eqs. (42), (43): the pose of a patch at the end of a chain.
TEST_P(PatchCovariance, OfThePoseIsThatOfTheChain) {
  SeededRandom random;
  const PatchTypeRow& type = *GetParam().type;
  const Patch patch = random_patch(random, GetParam(), 1.0);
  const UncertainPose a_from_b = random_pose(random, 1.0);
  const Patch moved = transform(a_from_b, patch);
  const int at = type.rotation_at(), size = type.rotation_size + 3;
  UncertainPose own = {world_from_patch(patch), Matrix6d::Zero()};  // lifted: zero variance of r_z
  const PatchMatrix cov = patch.covariance->bottomRightCorner(size, size);
  own.covariance.topLeftCorner(type.rotation_size, type.rotation_size) =
      cov.topLeftCorner(type.rotation_size, type.rotation_size);
  own.covariance.topRightCorner(type.rotation_size, 3) = cov.topRightCorner(type.rotation_size, 3);
  own.covariance.bottomLeftCorner(3, type.rotation_size) = cov.bottomLeftCorner(3, type.rotation_size);
  own.covariance.bottomRightCorner<3, 3>() = cov.bottomRightCorner<3, 3>();
  const UncertainPose end = compose({{a_from_b, +1}, {own, +1}});
  const PatchMatrix found = moved.covariance->block(at, at, size, size);
  const PatchMatrix expected =
      type.revolute() ? PatchMatrix(axis_pose(end).covariance) : PatchMatrix(end.covariance);
  EXPECT_TRUE(same_covariance(found, expected, 1e-11));
}

TEST_P(PatchCovariance, ADesignedPatchTakesThatOfThePoseAlone) {
  SeededRandom random;
  const Patch example = random_patch(random, GetParam());
  const Patch designed =
      make_patch(*example.type, boundary(example), curvatures(example), axes(example), centre(example));
  EXPECT_FALSE(transform(random_pose(random, 1.0).pose, designed).covariance);
  const Patch moved = transform(random_pose(random, 1.0), designed);
  ASSERT_TRUE(moved.covariance_local);
  EXPECT_EQ(moved.covariance_local->topLeftCorner(designed.type->boundary_size, designed.type->size()).norm(),
            0.0);
  EXPECT_GT(moved.covariance_local->bottomRightCorner(3, 3).trace(), 0.0);
}

TEST_P(PatchCovariance, SaysWhereTheParametersAreNearTheirSingularity) {
  SeededRandom random;
  EXPECT_EQ(near_singular(random_patch(random, GetParam(), pi - 0.05)),
            GetParam().type->revolute());  // 5 sigma
  EXPECT_FALSE(near_singular(random_patch(random, GetParam(), 1.0)));
}

// (d, kappa) and, in the world frame, rotation and translation: free of the choice of x_l and y_l.
Eigen::MatrixXd world_covariance(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  const int at = type.rotation_at();
  const Matrix3d R = axes(patch);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(at + 6, type.size());
  J.topLeftCorner(at, at).setIdentity();
  J.block(at, at, 3, type.rotation_size) = R.leftCols(type.rotation_size);
  J.bottomRightCorner<3, 3>() = R;
  return J * *patch.covariance_local * J.transpose();
}

TEST_P(PatchCovariance, SurvivesTheSingularOrientation) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam(), pi), back = flip_normal(flip_normal(patch));
  EXPECT_TRUE(patch.covariance->allFinite());
  EXPECT_LT((axes(back).col(2) - axes(patch).col(2)).norm(), 1e-14);
  const Eigen::MatrixXd expected = world_covariance(patch), found = world_covariance(back);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace patchlab::test
