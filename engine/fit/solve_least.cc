#include "engine/fit/solve_least.h"

#include <Eigen/Eigenvalues>
#include <limits>

namespace patchlab {

Eigen::VectorXd solve_least(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double least =
      static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon() * values[A.rows() - 1];
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const auto v = eigen.eigenvectors().col(i);
    if (values[i] > least) x += v * (v.dot(b) / values[i]);
  }
  return x;
}

}  // namespace patchlab
