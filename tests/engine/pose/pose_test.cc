#include "engine/pose/pose.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "tests/support/monte_carlo.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

using std::numbers::pi;

Pose pose_of(const VectorXd& v) { return {v.head<3>(), v.tail<3>()}; }

Pose random_pose(Random& random, double length) { return {length * random.unit3(), random.normal3()}; }

Eigen::Matrix4d homogeneous(const Pose& pose) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = exp_map(pose.r);
  T.topRightCorner<3, 1>() = pose.t;
  return T;
}

TEST(Pose, InverseUndoesApply) {
  SeededRandom random;
  for (const double length : {0.0, 1e-8, 1.0, pi, 8.0}) {
    const Pose pose = random_pose(random, length);
    const Vector3d q = random.normal3();
    EXPECT_LT((apply_inverse(pose, apply(pose, q)) - q).norm(), 2e-14);
    EXPECT_LT((apply(inverse(pose), apply(pose, q)) - q).norm(), 2e-14);
  }
}

TEST(Pose, ComposeIsTheProductOfTransforms) {
  SeededRandom random;
  const Pose a = random_pose(random, 2.5), b = random_pose(random, 3.0), ab = compose(a, b);
  EXPECT_LT((homogeneous(ab) - homogeneous(a) * homogeneous(b)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LE(ab.r.norm(), pi);
}

TEST(Pose, PointDerivativesMatchDifferences) {
  SeededRandom random;
  for (const double length : {0.0, 1e-8, 1.0, pi, 8.0}) {
    const Pose pose = random_pose(random, length);
    const Vector3d q = random.normal3();
    const PointJacobians forward = J_apply(pose, q), back = J_apply_inverse(pose, q);
    const auto of = [&](auto map) {
      return [&, map](const VectorXd& x) -> VectorXd { return map(pose_of(x), q); };
    };
    Eigen::Matrix<double, 3, 6> J;
    J << forward.J_r, forward.J_t;
    EXPECT_TRUE(jacobian_matches(J, of(apply), pose.vector()));
    J << back.J_r, back.J_t;
    EXPECT_TRUE(jacobian_matches(J, of(apply_inverse), pose.vector()));
    EXPECT_TRUE(jacobian_matches(
        forward.J_q, [&](const VectorXd& x) -> VectorXd { return apply(pose, x); }, q));
    EXPECT_TRUE(jacobian_matches(
        back.J_q, [&](const VectorXd& x) -> VectorXd { return apply_inverse(pose, x); }, q));
  }
}

TEST(Pose, InverseHasTheRightDerivative) {
  SeededRandom random;
  for (const double length : {0.0, 1e-8, 1.0, pi, 8.0}) {
    const Pose pose = random_pose(random, length);
    EXPECT_TRUE(jacobian_matches(
        J_inverse(pose), [](const VectorXd& x) -> VectorXd { return inverse(pose_of(x)).vector(); },
        pose.vector()));
  }
}

TEST(Pose, InvertingTwiceGivesTheCovarianceBack) {
  SeededRandom random;
  const UncertainPose pose = {random_pose(random, 2.0), random_covariance(random, 6, 0.01)};
  const UncertainPose twice = inverse(inverse(pose));
  EXPECT_LT((twice.pose.vector() - pose.pose.vector()).norm(), 1e-14);
  EXPECT_LT((twice.covariance - pose.covariance).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Pose, CanonicalFormCarriesTheCovarianceAlong) {
  SeededRandom random;
  const UncertainPose pose = {random_pose(random, 5.0), random_covariance(random, 6, 1e-3)};
  const UncertainPose canonical_pose = canonical(pose);
  EXPECT_LE(canonical_pose.pose.r.norm(), pi);
  constexpr int count = 4000;
  const auto change = [&](const VectorXd& e) -> VectorXd {
    const UncertainPose moved = canonical(UncertainPose{pose_of(pose.pose.vector() + e), Matrix6d::Zero()});
    return moved.pose.vector() - canonical_pose.pose.vector();
  };
  EXPECT_TRUE(covariance_agrees(canonical_pose.covariance,
                                sampled_covariance(random, pose.covariance, count, change), count));
}

// The tangent vectors are those of T = Tbar Exp(xi) and T = Exp(xi) Tbar; near zero Exp(xi) has rotation
// R(xi_rot) and translation xi_trans to first order.
TEST(Pose, TangentConversionsMatchDifferences) {
  SeededRandom random;
  const Pose mean = random_pose(random, 2.0);
  const Eigen::Matrix4d T_inverse = homogeneous(mean).inverse();
  const auto tangent = [](const Eigen::Matrix4d& T) {
    Vector6d xi;
    xi << log_map(T.topLeftCorner<3, 3>()), T.topRightCorner<3, 1>();
    return xi;
  };
  const auto right = [&](const VectorXd& x) -> VectorXd {
    return tangent(T_inverse * homogeneous(pose_of(x)));
  };
  const auto left = [&](const VectorXd& x) -> VectorXd {
    return tangent(homogeneous(pose_of(x)) * T_inverse);
  };
  const auto fixed_axes = [&](const VectorXd& x) -> VectorXd {
    Vector6d xi;
    xi << x.tail<3>() - mean.t, log_map(exp_map(x.head<3>()) * exp_map(mean.r).transpose());
    return xi;
  };
  EXPECT_TRUE(jacobian_matches(right_rot_trans_from_rt(mean), right, mean.vector()));
  EXPECT_TRUE(jacobian_matches(left_rot_trans_from_rt(mean), left, mean.vector()));
  EXPECT_TRUE(jacobian_matches(ros_fixed_axes_from_rt(mean), fixed_axes, mean.vector()));
}

}  // namespace
}  // namespace patchlab::test
