// Symmetric systems of a fit's size, whose loops the compiler writes out: a quarter of the time of a general
// factor.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

#include "engine/base/repeat.h"

namespace patchlab {

// At most 9 parameters on the stack: no allocation inside a fit.
using StepVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
using StepMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;

// A = L D L', by columns of L.
template <int size>
class Cholesky {
 public:
  explicit Cholesky(const StepMatrix& A) {
    repeat<size>([&](auto j) {
      repeat<size - j>([&](auto below) { L_[j][j + below] = A.data()[j * size + j + below]; });
    });
    repeat<size>([&](auto j) {
      D_[j] = L_[j][j];
      positive_ = positive_ && D_[j] > 0.0;
      inverse_[j] = 1.0 / D_[j];
      repeat<size - 1 - j>([&](auto after) {
        constexpr int k = j + 1 + after;
        const double share = L_[j][k] * inverse_[j];
        repeat<size - k>([&](auto below) { L_[k][k + below] -= share * L_[j][k + below]; });
      });
      repeat<size - 1 - j>([&](auto after) { L_[j][j + 1 + after] *= inverse_[j]; });
    });
  }
  bool positive() const { return positive_; }
  double least_pivot() const { return *std::min_element(D_, D_ + size); }

  void solve(double* b) const {  // in place
    double x[size];
    repeat<size>([&](auto j) { x[j] = b[j]; });
    repeat<size>([&](auto j) {
      repeat<size - 1 - j>([&](auto after) { x[j + 1 + after] -= L_[j][j + 1 + after] * x[j]; });
    });
    repeat<size>([&](auto j) { x[j] *= inverse_[j]; });
    repeat<size>([&](auto up) {
      constexpr int j = size - 1 - up;
      repeat<j>([&](auto i) { x[i] -= L_[i][j] * x[j]; });
    });
    repeat<size>([&](auto j) { b[j] = x[j]; });
  }

 private:
  double L_[size][size], D_[size], inverse_[size];  // 1 / D
  bool positive_ = true;
};

// use(factor) of A, which has at most 9 rows; each size is compiled.
template <int size = 1, class Use>
auto with_factor(const StepMatrix& A, const Use& use) {
  if constexpr (size < 9) {
    if (A.rows() != size) return with_factor<size + 1>(A, use);
  }
  return use(Cholesky<size>(A));
}

// The solution of A X = B, A symmetric and positive definite or nearly so.
template <class Right>
Right solve_positive(const StepMatrix& A, const Right& B) {
  return with_factor(A, [&](const auto& factor) -> Right {
    if (!factor.positive()) return A.ldlt().solve(B);
    Right X = B;
    for (Eigen::Index column = 0; column < X.cols(); ++column) factor.solve(X.data() + column * X.rows());
    return X;
  });
}

}  // namespace patchlab
