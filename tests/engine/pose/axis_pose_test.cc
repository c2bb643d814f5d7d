#include "engine/pose/axis_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/pose/chain.h"
#include "tests/engine/pose/hard_vectors.h"
#include "tests/support/exact.h"
#include "tests/support/monte_carlo.h"
#include "tests/support/numeric_jacobian.h"

namespace patchlab::test {
namespace {

using std::numbers::pi;

// How far theta_xy may be trusted: errata section 9.
double growth_near_pi(const Vector2d& r_xy) { return std::max(1.0, pi / std::max(pi - r_xy.norm(), 1e-300)); }

TEST(AxisPose, TurnsTheNormalAsTheFullRotationDoes) {
  SeededRandom random;
  for (const Vector3d& r : all_vectors(random)) {
    const Vector3d error = exp_map(lift(r_xy(r))).col(2) - exp_map(r).col(2);
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 4e-15 * growth(r)) << r.transpose();
    EXPECT_LE(r_xy(r).norm(), pi * (1.0 + 1e-15));
  }
}

TEST(AxisPose, AgreesWithThePrintedFormulaAwayFromItsSingularity) {
  SeededRandom random;
  for (const Vector3d& r : canonical_vectors(random)) {
    const auto exact = exact_r_xy(r.cast<Exact>());
    const Vector2d found = r_xy(r);
    if (pi - found.norm() < 1e-9) continue;
    EXPECT_LT(largest_error(found, exact), 1e-14 * growth_near_pi(found)) << r.transpose();
  }
}

TEST(AxisPose, VectorsInThePlaneAreTheirOwn) {
  SeededRandom random;
  for (Vector3d r : canonical_vectors(random)) {
    r.z() = 0.0;
    EXPECT_LT((r_xy(r) - r.head<2>()).cwiseAbs().maxCoeff(), 4e-15) << r.transpose();
  }
}

TEST(AxisPose, ExactlyOppositeNormalGivesTheVectorOfThePrintedRule) {
  const Vector2d u = pi * Vector2d(0.6, -0.8);
  EXPECT_LT((r_xy(lift(u)) - u).norm(), 4e-15);
}

TEST(AxisPose, JacobianIsExact) {
  SeededRandom random;
  for (const Vector3d& r : canonical_vectors(random)) {
    if (pi - r_xy(r).norm() < 1e-9) continue;
    Eigen::Matrix<Exact, 2, 3> exact;
    for (int k = 0; k < 3; ++k) exact.col(k) = exact_derivative(exact_r_xy, r.cast<Exact>(), k);
    const double largest = static_cast<double>(exact.cwiseAbs().maxCoeff());
    EXPECT_LT(largest_error(J_r_xy_r(r), exact), 1e-14 * growth_near_pi(r_xy(r)) * largest) << r.transpose();
  }
}

TEST(AxisPose, JacobianOfLongVectorsMatchesDifferences) {
  SeededRandom random;
  const Vector3d r = 8.0 * random.unit3();
  EXPECT_TRUE(jacobian_matches(J_r_xy_r(r), [](const VectorXd& x) -> VectorXd { return r_xy(Vector3d(x)); },
                               r, {.step = 1e-4, .tolerance = 1e-9}));
}

TEST(AxisPose, RotationAboutTheNormalIsInvisible) {
  SeededRandom random;
  for (int i = 0; i < 20; ++i) {
    const Vector3d r = random.uniform(0.0, 3.0) * random.unit3();
    EXPECT_LT((J_r_xy_r(r) * right_jacobian_inverse(r).col(2)).norm(), 1e-13 * growth_near_pi(r_xy(r)));
  }
}

TEST(AxisPose, TiltJacobianIsThatOfTheReBasedChart) {
  SeededRandom random;
  for (const double length : {0.0, 1e-8, 0.5, 2.0, 3.0}) {
    const Vector2d u = length * random.unit3().head<2>().normalized();
    const auto tilted = [&](const VectorXd& a) -> VectorXd {
      return r_xy(log_map(exp_map(lift(u)) * exp_map(lift(Vector2d(a)))));
    };
    EXPECT_TRUE(
        jacobian_matches(J_r_xy_tilt(u), tilted, Vector2d::Zero(), {.step = 1e-4, .tolerance = 1e-9}));
    EXPECT_LT((J_r_xy_tilt(u) * J_tilt_r_xy(u) - Matrix2d::Identity()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(AxisPose, TiltJacobianStaysFiniteAtItsSingularity) {
  EXPECT_TRUE(J_r_xy_tilt({pi, 0.0}).allFinite());
  EXPECT_TRUE(J_tilt_r_xy({pi, 0.0}).allFinite());
  EXPECT_TRUE(J_r_xy_r({pi, 0.0, 0.0}).allFinite());
}

TEST(AxisPose, NearSingularLooksTwentyStandardDeviationsAhead) {
  const Matrix2d cov = Vector2d(1e-4, 1e-6).asDiagonal();  // sigma 0.01
  EXPECT_FALSE(near_singular({pi - 0.21, 0.0}, cov));
  EXPECT_TRUE(near_singular({0.0, pi - 0.19}, cov));
  EXPECT_TRUE(near_singular({pi - 0.5e-6, 0.0}, Matrix2d::Zero()));
  EXPECT_FALSE(near_singular({pi - 2e-6, 0.0}, Matrix2d::Zero()));
}

TEST(AxisPose, TiltCovarianceHoldsWhereThatOfRxyDoesNot) {
  SeededRandom random;
  UncertainPose pose;
  pose.pose = {pi * Vector3d(0.8, 0.6, 0.0), random.normal3()};
  pose.covariance = random_covariance(random, 6, 1e-3);
  const UncertainAxisPose axis = axis_pose(pose);
  EXPECT_TRUE(axis.near_singular);
  const Matrix3d R0 = exp_map(lift(axis.r_xy));
  constexpr int count = 4000;
  const auto tilt = [&](const VectorXd& e) -> VectorXd {
    return r_xy(log_map(R0.transpose() * exp_map(pose.pose.r + e.head<3>())));
  };
  EXPECT_TRUE(
      covariance_agrees(axis.cov_tilt, sampled_covariance(random, pose.covariance, count, tilt), count));
}

}  // namespace
}  // namespace patchlab::test
