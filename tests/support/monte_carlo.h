// First-order covariances against samples.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <functional>

#include "engine/base/random.h"

namespace patchlab::test {

// A random covariance with standard deviations between `sigma` and 2 `sigma` and correlations.
inline Eigen::MatrixXd random_covariance(Random& random, int size, double sigma) {
  Eigen::MatrixXd L(size, size);
  for (double& entry : L.reshaped()) entry = random.uniform(-1.0, 1.0);
  const Eigen::MatrixXd cov = L * L.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
  const Eigen::VectorXd scale = cov.diagonal().unaryExpr(
      [&](double variance) { return sigma * random.uniform(1.0, 2.0) / std::sqrt(variance); });
  return scale.asDiagonal() * cov * scale.asDiagonal();
}

// Covariance of f(x), x normal about zero with `cov`, from `count` samples and their mirror images; f(0) = 0.
inline Eigen::MatrixXd sampled_covariance(Random& random, const Eigen::MatrixXd& cov, int count,
                                          const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f) {
  const Eigen::MatrixXd L = cov.llt().matrixL();
  Eigen::MatrixXd sum;
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd e(cov.rows());
    for (double& entry : e) entry = random.normal();
    const Eigen::VectorXd odd = 0.5 * (f(L * e) - f(-(L * e)));  // even terms, of second order, cancel
    if (i == 0) sum = Eigen::MatrixXd::Zero(odd.size(), odd.size());
    sum += odd * odd.transpose();
  }
  return sum / count;
}

// Every entry within five standard deviations of the sampling error.
inline testing::AssertionResult covariance_agrees(const Eigen::MatrixXd& cov, const Eigen::MatrixXd& sampled,
                                                  int count) {
  for (Eigen::Index i = 0; i < cov.rows(); ++i) {
    for (Eigen::Index j = 0; j < cov.cols(); ++j) {
      const double sigma = std::sqrt((cov(i, i) * cov(j, j) + cov(i, j) * cov(i, j)) / count);
      if (std::abs(sampled(i, j) - cov(i, j)) <= 5.0 * sigma + 1e-300) continue;
      return testing::AssertionFailure()
             << "row " << i << ", column " << j << ": " << cov(i, j) << " by formula, " << sampled(i, j)
             << " sampled (standard deviation " << sigma << ")";
    }
  }
  return testing::AssertionSuccess();
}

}  // namespace patchlab::test
