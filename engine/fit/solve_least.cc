#include "engine/fit/solve_least.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>

namespace patchlab {

StepVector solve_least(const StepMatrix& A, const StepVector& b) {
  constexpr double clearly = 1e-8;
  const Eigen::LLT<StepMatrix> factor(A);
  const double pivot = factor.matrixLLT().diagonal().cwiseAbs2().minCoeff();
  if (factor.info() == Eigen::Success && pivot > clearly * A.diagonal().maxCoeff()) return factor.solve(b);
  const Eigen::SelfAdjointEigenSolver<StepMatrix> eigen(A);
  const StepVector& values = eigen.eigenvalues();
  const double least =
      static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon() * values[A.rows() - 1];
  StepVector x = StepVector::Zero(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const auto v = eigen.eigenvectors().col(i);
    if (values[i] > least) x += v * (v.dot(b) / values[i]);
  }
  return x;
}

}  // namespace patchlab
