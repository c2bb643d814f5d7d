#include "engine/pose/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "tests/engine/pose/hard_vectors.h"
#include "tests/support/exact.h"
#include "tests/support/numeric_jacobian.h"

namespace patchlab::test {
namespace {

using std::numbers::pi;

Matrix3d rounded(const ExactMatrix3& exact) { return exact.cast<double>(); }

TEST(Rotation, SkewIsTheCrossProduct) {
  SeededRandom random;
  const Vector3d v = random.normal3(), w = random.normal3();
  EXPECT_LT((skew(v) * w - v.cross(w)).norm(), 1e-15);
}

TEST(Rotation, ExponentialMapIsExactEverywhere) {
  SeededRandom random;
  for (const Vector3d& r : all_vectors(random)) {
    EXPECT_LT(largest_error(exp_map(r), exact_exp_map(r.cast<Exact>())), 2e-15 * growth(r)) << r.transpose();
  }
}

TEST(Rotation, ExponentialMapGivesRotations) {
  SeededRandom random;
  for (const Vector3d& r : all_vectors(random)) {
    const Matrix3d R = exp_map(r);
    EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 4e-15 * growth(r))
        << r.transpose();
    EXPECT_NEAR(R.determinant(), 1.0, 4e-15 * growth(r)) << r.transpose();
  }
}

TEST(Rotation, SlicesOfItsDerivativeAreExact) {
  SeededRandom random;
  for (const Vector3d& r : all_vectors(random)) {
    const auto slices = J_R_r(r);
    for (int k = 0; k < 3; ++k) {
      const ExactMatrix3 exact = exact_derivative(exact_exp_map, r.cast<Exact>(), k);
      EXPECT_LT(largest_error(slices[static_cast<std::size_t>(k)], exact), 4e-15 * growth(r))
          << "slice " << k << " at " << r.transpose();
    }
  }
}

TEST(Rotation, LeftAndRightJacobianAreExact) {
  SeededRandom random;
  for (const Vector3d& r : all_vectors(random)) {
    const ExactMatrix3 Jl = exact_left_jacobian(r.cast<Exact>());
    EXPECT_LT(largest_error(left_jacobian(r), Jl), 4e-15 * growth(r)) << r.transpose();
    EXPECT_LT(largest_error(right_jacobian(r), Jl.transpose()), 4e-15 * growth(r)) << r.transpose();
  }
}

TEST(Rotation, InverseJacobiansAreExactForCanonicalVectors) {
  SeededRandom random;
  for (const Vector3d& r : canonical_vectors(random)) {
    const ExactMatrix3 inverse = exact_left_jacobian(r.cast<Exact>()).inverse();
    EXPECT_LT(largest_error(left_jacobian_inverse(r), inverse), 4e-15) << r.transpose();
    EXPECT_LT(largest_error(right_jacobian_inverse(r), inverse.transpose()), 4e-15) << r.transpose();
  }
}

TEST(Rotation, LogMapIsExactEverywhere) {
  SeededRandom random;
  for (const Vector3d& r : canonical_vectors(random)) {
    const Vector3d found = log_map(rounded(exact_exp_map(r.cast<Exact>())));
    EXPECT_LE(found.norm(), pi * (1.0 + 1e-15));
    if (pi - r.norm() < 1e-14) {  // r and -r are one rotation
      EXPECT_LT((exp_map(found) - exp_map(r)).cwiseAbs().maxCoeff(), 4e-15) << r.transpose();
    } else {
      EXPECT_LT((found - r).cwiseAbs().maxCoeff(), 4e-15) << r.transpose();
    }
  }
}

TEST(Rotation, LogMapKeepsTheRelativePrecisionOfSmallRotations) {
  SeededRandom random;
  for (const double length : {1e-160, 1e-20, 1e-8}) {
    const Vector3d r = length * random.unit3();
    EXPECT_LT((log_map(exp_map(r)) - r).norm(), 1e-15 * length);
  }
}

TEST(Rotation, HalfTurnsHaveTheirLargestComponentPositive) {
  SeededRandom random;
  for (int i = 0; i < 50; ++i) {
    const Vector3d n = random.unit3();
    const Matrix3d R =
        2.0 * n * n.transpose() - Matrix3d::Identity();  // symmetric to the last bit: w = 0 exactly
    const Vector3d r = log_map(R);
    Eigen::Index largest = 0;
    R.diagonal().maxCoeff(&largest);
    EXPECT_GT(r[largest], 0.0);
    EXPECT_LT((exp_map(r) - R).cwiseAbs().maxCoeff(), 4e-15);
  }
}

TEST(Rotation, DerivativesOfRotatedVectorsMatchDifferences) {
  SeededRandom random;
  for (const double length : {0.0, 1e-8, 0.3, 2.0, pi - 1e-6, pi, 8.0}) {
    const Vector3d r = length * random.unit3(), v = random.normal3();
    EXPECT_TRUE(jacobian_matches(
        J_Rv_r(r, v), [&](const VectorXd& x) -> VectorXd { return exp_map(x) * v; }, r));
    EXPECT_TRUE(jacobian_matches(
        J_Rtv_r(r, v), [&](const VectorXd& x) -> VectorXd { return exp_map(x).transpose() * v; }, r));
  }
}

TEST(Rotation, CanonicalVectorIsTheSameRotationAndNoLongerThanPi) {
  SeededRandom random;
  for (const Vector3d& r : all_vectors(random)) {
    const Reparametrised c = canonical(r);
    EXPECT_LE(c.r.norm(), pi * (1.0 + 1e-15));
    EXPECT_LT(largest_error(exp_map(c.r), exact_exp_map(r.cast<Exact>())), 4e-15 * growth(r))
        << r.transpose();
  }
}

TEST(Rotation, CanonicalVectorsAreLeftAlone) {
  SeededRandom random;
  for (const Vector3d& r : canonical_vectors(random)) {
    EXPECT_EQ(canonical(r).r, r);
    EXPECT_EQ(canonical(r).J, Matrix3d::Identity());
  }
}

TEST(Rotation, ReparametrisationCarriesPerturbationsAlong) {
  SeededRandom random;
  for (const double length : {3.3, 5.0, 8.0, 30.0}) {
    const Vector3d r = length * random.unit3();
    const Reparametrised c = canonical(r);
    EXPECT_TRUE(jacobian_matches(
        c.J, [](const VectorXd& x) -> VectorXd { return canonical(Vector3d(x)).r; }, r));
    EXPECT_LT((c.J - left_jacobian_inverse(c.r) * left_jacobian(r)).cwiseAbs().maxCoeff(), 1e-14 * length);
  }
}

TEST(Rotation, NearestBranchIsTheSameRotationNextToTheReference) {
  SeededRandom random;
  for (int i = 0; i < 20; ++i) {
    const Vector3d n = random.unit3();
    const Vector3d reference = (pi - 0.01) * n;
    const Vector3d across_the_cut = -(pi - 0.01) * (n + 0.001 * random.normal3()).normalized();
    const Reparametrised near = nearest_branch(across_the_cut, reference);
    EXPECT_LT((near.r - reference).norm(), 0.05);
    EXPECT_LT((exp_map(near.r) - exp_map(across_the_cut)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_TRUE(jacobian_matches(
        near.J, [&](const VectorXd& x) -> VectorXd { return nearest_branch(Vector3d(x), reference).r; },
        across_the_cut));
  }
}

TEST(Rotation, NearestBranchLeavesNeighboursAlone) {
  SeededRandom random;
  const Vector3d r = 2.0 * random.unit3();
  EXPECT_EQ(nearest_branch(r, r + 0.1 * random.unit3()).r, r);
  EXPECT_EQ(nearest_branch(Vector3d::Zero(), r).r, Vector3d::Zero());
}

TEST(Rotation, ShortestTurnTakesOneDirectionToTheOther) {
  SeededRandom random;
  const std::vector<Vector3d> all = scaled(directions(random), {1.0, -1.0, 2.5});
  for (const Vector3d& from : all) {
    for (const Vector3d& to : all) {
      const Vector3d a = from.normalized(), b = to.normalized();
      const Vector3d r = log_map(shortest_turn(from, to));
      EXPECT_LT((exp_map(r) * a - b).norm(), 1e-14) << from.transpose() << " to " << to.transpose();
      EXPECT_NEAR(r.norm(), std::atan2(a.cross(b).norm(), a.dot(b)), 1e-14);
    }
  }
}

TEST(NearestRotation, AcceptsRotationsAsTheyAre) {
  SeededRandom random;
  const Matrix3d R = exp_map(random.normal3());
  const Result<Matrix3d> found = nearest_rotation(R);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, R);
}

TEST(NearestRotation, ProjectsWhatIsNearlyARotation) {
  SeededRandom random;
  const Matrix3d R = exp_map(random.normal3());
  const Result<Matrix3d> found =
      nearest_rotation(R + 1e-4 * Matrix3d(random.normal3() * random.unit3().transpose()));
  ASSERT_TRUE(found);
  EXPECT_LT((found->transpose() * *found - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 4e-15);
  EXPECT_LT((*found - R).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(NearestRotation, RefusesWhatIsNone) {
  EXPECT_FALSE(nearest_rotation(1.01 * Matrix3d::Identity()));
  EXPECT_FALSE(nearest_rotation(Vector3d(1, 1, -1).asDiagonal()));
  EXPECT_FALSE(nearest_rotation(Matrix3d::Constant(std::nan(""))));
}

}  // namespace
}  // namespace patchlab::test
