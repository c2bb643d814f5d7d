#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "engine/io/pose_covariance.h"
#include "tests/engine/io/sample_set.h"

namespace patchlab {
namespace {

// The patches of the sample set, 5-DoF or 6-DoF.
std::vector<PatchRecord> records(bool revolute) {
  std::vector<PatchRecord> chosen;
  for (const PatchRecord& record : test::sample_set().patches) {
    if (record.patch.type->revolute() == revolute) chosen.push_back(record);
  }
  EXPECT_GE(chosen.size(), 4u);
  return chosen;
}

TEST(RosCovariance, IsThatOfThePoseAboutFixedAxes) {
  for (const PatchRecord& record : records(false)) {
    const Matrix6d G = ros_fixed_axes_from_rt(world_from_patch(record.patch));
    const Matrix6d expected = G * record.patch.covariance->bottomRightCorner<6, 6>() * G.transpose();
    EXPECT_LT((ros_fixed_axes_covariance(record.patch) - expected).norm(), 1e-12 * expected.norm())
        << record.id;
  }
}

TEST(RosCovariance, SaysThatTheSpinOfARevolutePatchIsUnknown) {
  for (const PatchRecord& record : records(true)) {
    const Matrix6d cov = ros_fixed_axes_covariance(record.patch);
    const Vector3d z = axes(record.patch).col(2);
    EXPECT_NEAR(z.dot(cov.bottomRightCorner<3, 3>() * z), std::numbers::pi * std::numbers::pi / 3.0, 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(cov).eigenvalues()[0], 0.0);
    EXPECT_EQ(cov, cov.transpose());
  }
}

// The tilt as E of errata section 4 takes it from r_xy: a route that does not pass through covariance_local.
TEST(RosCovariance, HasTheTiltAndThePlaceOfARevolutePatch) {
  for (const PatchRecord& record : records(true)) {
    const Patch& patch = record.patch;
    const int at = patch.type->rotation_at();
    const Matrix2d J = J_tilt_r_xy(patch.parameters.segment<2>(at));
    const Matrix2d cov_tilt = J * patch.covariance->block<2, 2>(at, at) * J.transpose();
    const Matrix6d cov = ros_fixed_axes_covariance(patch);
    const Matrix3d R = axes(patch);
    const Matrix3d cov_body = R.transpose() * cov.bottomRightCorner<3, 3>() * R;
    const double rounding = 1e-15;  // of the variance of the spin, which stands beside it
    EXPECT_LT((cov_body.topLeftCorner<2, 2>() - cov_tilt).norm(), rounding);
    EXPECT_GT(cov_tilt.norm(), 1e6 * rounding);
    EXPECT_LT((cov.topLeftCorner<3, 3>() - patch.covariance->bottomRightCorner<3, 3>()).norm(), 1e-18);
  }
}

}  // namespace
}  // namespace patchlab
