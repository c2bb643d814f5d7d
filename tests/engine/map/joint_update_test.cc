// The joint update against the algebra of its own estimate, which is linear in what was measured.
#include "engine/map/joint_update.h"

#include <gtest/gtest.h>

#include "engine/map/weigh.h"
#include "tests/support/monte_carlo.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Random& random, int rows, int cols) {
  MatrixXd A(rows, cols);
  for (double& entry : A.reshaped()) entry = random.normal();
  return A;
}

Measurement random_measurement(Random& random) {
  const int size = 7, rows = 4;
  return {random_covariance(random, size, 1.0), VectorXd::Zero(rows),
          random_matrix(random, rows, size),    random_matrix(random, rows, 6),
          random_covariance(random, rows, 1.0), random_matrix(random, size, 6)};
}

// The estimates of all patches by y, all patches' and all rows' in a column.
MatrixXd estimate_by_y(std::vector<Measurement> measurements, const SharedError& prior) {
  MatrixXd out(7 * measurements.size(), 4 * measurements.size());
  for (Eigen::Index column = 0; column < out.cols(); ++column) {
    for (std::size_t i = 0; i < measurements.size(); ++i)
      for (Eigen::Index k = 0; k < 4; ++k) measurements[i].y[k] = 4 * Eigen::Index(i) + k == column;
    const JointUpdate update = update_jointly(measurements, prior);
    for (std::size_t i = 0; i < measurements.size(); ++i)
      out.block(7 * Eigen::Index(i), column, 7, 1) = update.patches[i].x;
  }
  return out;
}

// Of x + T delta less its estimate, of all patches, from the covariances of x, delta and the noise.
MatrixXd covariance_of_errors(const std::vector<Measurement>& measurements, const SharedError& prior) {
  const MatrixXd M = estimate_by_y(measurements, prior);
  const auto n = static_cast<Eigen::Index>(measurements.size());
  MatrixXd T(7 * n, 6), H = MatrixXd::Zero(4 * n, 7 * n), G(4 * n, 6), P = MatrixXd::Zero(7 * n, 7 * n),
                        R = MatrixXd::Zero(4 * n, 4 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Measurement& m = measurements[static_cast<std::size_t>(i)];
    T.middleRows(7 * i, 7) = m.T;
    G.middleRows(4 * i, 4) = m.G;
    H.block(4 * i, 7 * i, 4, 7) = m.H;
    P.block(7 * i, 7 * i, 7, 7) = m.P;
    R.block(4 * i, 4 * i, 4, 4) = m.R;
  }
  const MatrixXd by_x = MatrixXd::Identity(7 * n, 7 * n) - M * H, by_delta = T - M * G;
  return by_x * P * by_x.transpose() + by_delta * prior.covariance * by_delta.transpose() +
         M * R * M.transpose();
}

class JointUpdates : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Gain, JointUpdates, testing::Bool(),
                         [](const auto& levelled) { return levelled.param ? "Another" : "Best"; });

TEST_P(JointUpdates, HaveTheCovarianceOfTheirErrors) {
  SeededRandom random;
  std::vector<Measurement> measurements;
  for (int i = 0; i < 3; ++i) {
    measurements.push_back(random_measurement(random));
    if (!GetParam()) continue;
    Measurement& m = measurements.back();
    m.R_gain = levelled(m, 2);
    m.P_gain = m.P - m.P.col(5) * m.P.row(5) / m.P(5, 5);
  }
  const SharedError prior{Vector6d::Zero(), random_covariance(random, 6, 0.7)};
  const MatrixXd expected = covariance_of_errors(measurements, prior);
  const JointUpdate update = update_jointly(measurements, prior);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const PatchMatrix& P = update.patches[static_cast<std::size_t>(i)].P;
    EXPECT_LT((P - expected.block(7 * i, 7 * i, 7, 7)).norm(), 1e-11 * P.norm());
  }
}

// Of one number that was seen `sights` times with variance 1.
Measurement seen_again(int sights, double variance) {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  return {one / sights, VectorXd::Zero(1), one, MatrixXd::Zero(1, 6), variance * one, MatrixXd::Zero(1, 6)};
}

TEST(Levelling, LetsSightsThatAreAlikeCountAlike) {
  for (const double variance : {0.5, 0.7, 1.0, 1.5, 2.0})
    EXPECT_NEAR(levelled(seen_again(4, variance), 4)(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(levelled(seen_again(4, 0.1), 4)(0, 0), 0.2, 1e-12);
  EXPECT_NEAR(levelled(seen_again(4, 10.0), 4)(0, 0), 5.0, 1e-12);
  EXPECT_EQ(levelled(seen_again(4, 0.0), 4)(0, 0), 0.0) << "a sight without error";
}

TEST(Levelling, CostsAnEighthOfTheVarianceAtMost) {
  for (int sights = 1; sights <= 20; ++sights) {
    for (double variance = 1e-3; variance < 1e3; variance *= 1.3) {
      Measurement m = seen_again(sights, variance);
      const double best = update_jointly({m}, {}).patches[0].P(0, 0);
      m.R_gain = levelled(m, sights);
      const double found = update_jointly({m}, {}).patches[0].P(0, 0);
      EXPECT_LE(found, 1.1251 * best) << sights << " sights, then one of variance " << variance;
      EXPECT_LE(found, m.P(0, 0)) << "it never grows";
    }
  }
}

}  // namespace
}  // namespace patchlab::test
