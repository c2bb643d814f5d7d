#include "engine/fit/solve_least.h"

#include <Eigen/Eigenvalues>
#include <limits>
#include <optional>

namespace patchlab {
namespace {

// Where no direction is nearly open.
std::optional<StepVector> by_factor(const StepMatrix& A, const StepVector& b) {
  constexpr double clearly = 1e-8;
  const double least = clearly * A.diagonal().maxCoeff();
  return with_factor(A, [&](const auto& factor) -> std::optional<StepVector> {
    if (!factor.positive() || !(factor.least_pivot() > least)) return std::nullopt;
    StepVector x = b;
    factor.solve(x.data());
    return x;
  });
}

}  // namespace

StepVector solve_least(const StepMatrix& A, const StepVector& b) {
  if (const std::optional<StepVector> x = by_factor(A, b)) return *x;
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
