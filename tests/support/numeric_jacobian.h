// The one check of every Jacobian: against central differences.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>

namespace patchlab::test {

using Eigen::VectorXd;

// A lambda for it names its return type, -> VectorXd: an Eigen expression would outlive what it refers to.
using VectorFunction = std::function<VectorXd(const VectorXd&)>;

// d f / d x at x, by the five-point rule: the error is about step^4 of the fifth derivative and 1e-16 |f| /
// step.
inline Eigen::MatrixXd numeric_jacobian(const VectorFunction& f, const VectorXd& x, double step) {
  Eigen::MatrixXd J(f(x).size(), x.size());
  for (Eigen::Index column = 0; column < x.size(); ++column) {
    const auto at = [&](double steps) {
      VectorXd moved = x;
      moved[column] += steps * step;
      return f(moved);
    };
    J.col(column) = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * step);
  }
  return J;
}

struct JacobianCheck {
  double step = 1e-3;
  double tolerance = 1e-10;  // of the entries, relative to the largest one or to 1
};

// EXPECT_TRUE(jacobian_matches(J, f, x)): names the first entry that is wrong, with both values.
inline testing::AssertionResult jacobian_matches(const Eigen::MatrixXd& J, const VectorFunction& f,
                                                 const VectorXd& x, JacobianCheck check = {}) {
  const Eigen::MatrixXd numeric = numeric_jacobian(f, x, check.step);
  if (J.rows() != numeric.rows() || J.cols() != numeric.cols()) {
    return testing::AssertionFailure() << "the Jacobian is " << J.rows() << " x " << J.cols()
                                       << ", but should be " << numeric.rows() << " x " << numeric.cols();
  }
  const double allowed = check.tolerance * std::max(1.0, numeric.cwiseAbs().maxCoeff());
  for (Eigen::Index row = 0; row < J.rows(); ++row) {
    for (Eigen::Index column = 0; column < J.cols(); ++column) {
      if (std::abs(J(row, column) - numeric(row, column)) <= allowed) continue;
      return testing::AssertionFailure()
             << "row " << row << ", column " << column << ": " << J(row, column) << " by formula, "
             << numeric(row, column) << " by differences (allowed: " << allowed
             << ") at x = " << x.transpose();
    }
  }
  return testing::AssertionSuccess();
}

}  // namespace patchlab::test
