// Symmetric systems of a fit's size, whose loops the compiler writes out: a quarter of the time of a general
// factor.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

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
      positive_ = positive_ && L_[j][j] > 0.0;
      inverse_[j] = 1.0 / L_[j][j];
      repeat<size - 1 - j>([&](auto after) {
        constexpr int k = j + 1 + after;
        const double share = L_[j][k] * inverse_[j];
        repeat<size - k>([&](auto below) { L_[k][k + below] -= share * L_[j][k + below]; });
      });
      repeat<size - 1 - j>([&](auto after) { L_[j][j + 1 + after] *= inverse_[j]; });
    });
  }
  bool positive() const { return positive_; }

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
  double L_[size][size];
  double inverse_[size];  // of D
  bool positive_ = true;
};

// The solution of A X = B, A symmetric and positive definite or nearly so; sizes up to 8 are compiled each.
template <int size = 1, class Right>
Right solve_positive(const StepMatrix& A, const Right& B) {
  if constexpr (size > 8) {
    return A.ldlt().solve(B);
  } else if (A.rows() != size) {
    return solve_positive<size + 1>(A, B);
  } else {
    const Cholesky<size> factor(A);
    if (!factor.positive()) return A.ldlt().solve(B);
    Right X = B;
    for (Eigen::Index column = 0; column < X.cols(); ++column) factor.solve(X.data() + column * size);
    return X;
  }
}

}  // namespace patchlab
