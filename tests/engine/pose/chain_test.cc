#include "engine/pose/chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/exact.h"
#include "tests/support/monte_carlo.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

Chain random_chain(Random& random, int size, double sigma) {
  Chain chain;
  for (int i = 0; i < size; ++i) {
    const Pose pose = {random.uniform(0.0, 3.0) * random.unit3(), random.normal3()};
    chain.push_back({{pose, random_covariance(random, 6, sigma)}, i % 3 == 1 ? -1 : +1});
  }
  return chain;
}

VectorXd stacked(const Chain& chain) {
  VectorXd x(6 * static_cast<Eigen::Index>(chain.size()));
  for (std::size_t j = 0; j < chain.size(); ++j) {
    x.segment<6>(6 * static_cast<Eigen::Index>(j)) = chain[j].pose.pose.vector();
  }
  return x;
}

Chain with_poses(Chain chain, const VectorXd& x) {
  for (std::size_t j = 0; j < chain.size(); ++j) {
    const Vector6d v = x.segment<6>(6 * static_cast<Eigen::Index>(j));
    chain[j].pose.pose = {v.head<3>(), v.tail<3>()};
  }
  return chain;
}

// The pose of the chain on the branch next to `near`.
VectorXd pose_near(const Chain& chain, const Pose& near) {
  Pose pose = chain_pose(chain);
  pose.r = nearest_branch(pose.r, near.r).r;
  return pose.vector();
}

// (r_c, t_c) of Eq. (10) by definition, with the rotation of element j moved by dr and its translation by dt.
Eigen::Matrix<Exact, 6, 1> exact_pose(const Chain& chain, std::size_t moved, const ExactVector3& dr,
                                      const ExactVector3& dt) {
  ExactMatrix3 R = ExactMatrix3::Identity();
  ExactVector3 t = ExactVector3::Zero();
  for (std::size_t j = chain.size(); j-- > 0;) {
    ExactVector3 r_j = chain[j].pose.pose.r.cast<Exact>(), t_j = chain[j].pose.pose.t.cast<Exact>();
    if (j == moved) r_j += dr, t_j += dt;
    const ExactMatrix3 R_j = exact_exp_map(Exact(chain[j].phi) * r_j);
    t = chain[j].phi > 0 ? ExactVector3(R_j * t + t_j) : ExactVector3(R_j * (t - t_j));
    R = (R_j * R).eval();
  }
  Eigen::Matrix<Exact, 6, 1> pose;
  pose << exact_log_map(R), t;
  return pose;
}

TEST(Chain, MapsPointsOneElementAfterTheOther) {
  SeededRandom random;
  const Chain chain = random_chain(random, 5, 0.0);
  const Vector3d q_end = random.normal3();
  Vector3d q = q_end;
  for (std::size_t j = chain.size(); j-- > 0;) {
    q = chain[j].phi > 0 ? apply(chain[j].pose.pose, q) : apply_inverse(chain[j].pose.pose, q);
  }
  EXPECT_LT((apply(chain_pose(chain), q_end) - q).norm(), 1e-13);
}

TEST(Chain, AnEmptyChainIsTheIdentity) {
  const UncertainPose pose = compose(Chain{});
  EXPECT_EQ(pose.pose.vector(), Vector6d::Zero());
  EXPECT_EQ(pose.covariance, Matrix6d::Zero());
}

TEST(Chain, JacobianIsExact) {
  SeededRandom random;
  const Chain chain = random_chain(random, 4, 0.0);
  const Eigen::MatrixXd J = J_chain(chain);
  const ExactVector3 zero = ExactVector3::Zero();
  for (std::size_t j = 0; j < chain.size(); ++j) {
    for (int k = 0; k < 3; ++k) {
      const auto by_r = [&](const ExactVector3& dr) { return exact_pose(chain, j, dr, zero); };
      const auto by_t = [&](const ExactVector3& dt) { return exact_pose(chain, j, zero, dt); };
      const auto column = static_cast<Eigen::Index>(6 * j) + k;
      EXPECT_LT(largest_error(J.col(column), exact_derivative(by_r, zero, k)), 1e-13) << "r of element " << j;
      EXPECT_LT(largest_error(J.col(column + 3), exact_derivative(by_t, zero, k)), 1e-13)
          << "t of element " << j;
    }
  }
}

TEST(Chain, JacobianOfALongChainMatchesDifferences) {
  SeededRandom random;
  Chain chain = random_chain(random, 20, 0.0);
  chain[7].pose.pose.r *= 8.0 / chain[7].pose.pose.r.norm();  // not canonical: allowed
  const Pose pose = chain_pose(chain);
  EXPECT_TRUE(jacobian_matches(
      J_chain(chain), [&](const VectorXd& x) -> VectorXd { return pose_near(with_poses(chain, x), pose); },
      stacked(chain), {.tolerance = 1e-9}));
}

TEST(Chain, CovarianceIsThatOfTheStackedJacobian) {
  SeededRandom random;
  const Chain chain = random_chain(random, 6, 0.01);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(36, 36);
  for (Eigen::Index j = 0; j < 6; ++j)
    S.block<6, 6>(6 * j, 6 * j) = chain[static_cast<std::size_t>(j)].pose.covariance;
  const Eigen::MatrixXd expected = J_chain(chain) * S * J_chain(chain).transpose();
  const Matrix6d cov = compose(chain).covariance;
  EXPECT_LT((cov - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
  EXPECT_EQ(cov, cov.transpose());
}

TEST(Chain, CovarianceAgreesWithSampling) {
  SeededRandom random;
  const Chain chain = random_chain(random, 4, 1e-3);
  const UncertainPose composed = compose(chain);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(24, 24);
  for (Eigen::Index j = 0; j < 4; ++j)
    S.block<6, 6>(6 * j, 6 * j) = chain[static_cast<std::size_t>(j)].pose.covariance;
  constexpr int count = 4000;
  const auto change = [&](const VectorXd& e) -> VectorXd {
    return pose_near(with_poses(chain, stacked(chain) + e), composed.pose) - composed.pose.vector();
  };
  EXPECT_TRUE(covariance_agrees(composed.covariance, sampled_covariance(random, S, count, change), count));
}

TEST(Chain, AChainAndItsReverseGiveTheInversePose) {
  SeededRandom random;
  const Chain chain = random_chain(random, 5, 0.01);
  Chain reverse(chain.rbegin(), chain.rend());
  for (ChainElement& element : reverse) element.phi = -element.phi;
  const UncertainPose back = compose(reverse), expected = inverse(compose(chain));
  EXPECT_LT((exp_map(back.pose.r) - exp_map(expected.pose.r)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((back.pose.t - expected.pose.t).norm(), 1e-13);
  const double scale = expected.covariance.cwiseAbs().maxCoeff();
  EXPECT_LT((back.covariance - expected.covariance).cwiseAbs().maxCoeff(), 1e-12 * scale);
}

nlohmann::json contract(const char* name) {
  std::ifstream file(std::filesystem::path(PATCHLAB_SOURCE_DIR) / "../shared/contracts" / name);
  return file ? nlohmann::json::parse(file) : nlohmann::json();
}

Eigen::MatrixXd matrix(const nlohmann::json& rows) {
  const bool is_vector = rows[0].is_number();
  Eigen::MatrixXd m(rows.size(), is_vector ? 1 : rows[0].size());
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    const nlohmann::json& row = rows[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      m(i, j) = is_vector ? row.get<double>() : row[static_cast<std::size_t>(j)].get<double>();
  }
  return m;
}

TEST(Chain, GivesTheNumbersOfTheContract) {
  const nlohmann::json input = contract("chain.json"), output = contract("chain.out.json");
  if (input.is_null() || output.is_null()) GTEST_SKIP() << "the contracts are not beside this checkout";
  Chain chain;
  for (const nlohmann::json& element : input["elements"]) {
    chain.push_back(
        {{{matrix(element["r"]), matrix(element["t"])}, matrix(element["covariance"])}, element["phi"]});
  }
  const UncertainPose pose = compose(chain);
  const UncertainAxisPose axis = axis_pose(pose);
  const auto differs = [](const Eigen::MatrixXd& a, const nlohmann::json& b) {
    return (a - matrix(b)).cwiseAbs().maxCoeff() / matrix(b).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(differs(pose.pose.r, output["r"]), 1e-12);
  EXPECT_LT(differs(pose.pose.t, output["t"]), 1e-12);
  EXPECT_LT(differs(pose.covariance, output["covariance"]), 1e-12);
  EXPECT_LT(differs(axis.r_xy, output["axis_pose"]["r_xy"]), 1e-12);
  EXPECT_LT(differs(axis.covariance, output["axis_pose"]["covariance"]), 1e-12);
  EXPECT_LT(differs(axis.cov_tilt, output["axis_pose"]["tilt_covariance"]), 1e-12);
  EXPECT_EQ(axis.near_singular, output["axis_pose"]["near_singular"].get<bool>());
}

}  // namespace
}  // namespace patchlab::test
