// Definitions of the paper evaluated with 60 digits: what a test compares double precision with.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace patchlab::test {

using Exact =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;
using ExactVector3 = Eigen::Matrix<Exact, 3, 1>;
using ExactMatrix3 = Eigen::Matrix<Exact, 3, 3>;

inline ExactMatrix3 exact_skew(const ExactVector3& v) {
  ExactMatrix3 v_x;
  v_x << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return v_x;
}

// The power series in [r]x with coefficients 1 / (n + shift)!: the exponential map for shift 0, its left
// Jacobian for 1.
inline ExactMatrix3 exact_series(const ExactVector3& r, int shift) {
  const ExactMatrix3 r_x = exact_skew(r);
  ExactMatrix3 term = ExactMatrix3::Identity(), sum = term;
  for (int n = 1; n < 300 && term.cwiseAbs().maxCoeff() > Exact(1e-70); ++n) {
    term = (term * r_x / Exact(n + shift)).eval();
    sum += term;
  }
  return sum;
}

inline ExactMatrix3 exact_exp_map(const ExactVector3& r) { return exact_series(r, 0); }
inline ExactMatrix3 exact_left_jacobian(const ExactVector3& r) { return exact_series(r, 1); }

// theta about the axis of R - R', by definition; not for theta = pi.
inline ExactVector3 exact_log_map(const ExactMatrix3& R) {
  const ExactVector3 v(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const Exact length = sqrt(v.dot(v));
  return length == 0 ? ExactVector3(ExactVector3::Zero())
                     : ExactVector3(v * (atan2(length, R.trace() - 1) / length));
}

// Eq. (8) as printed, for theta_xy < pi.
inline Eigen::Matrix<Exact, 2, 1> exact_r_xy(const ExactVector3& r) {
  const ExactVector3 z = exact_exp_map(r).col(2);
  const Exact s = sqrt(z.x() * z.x() + z.y() * z.y());
  if (s == 0) return {0, 0};
  const Exact theta = atan2(s, z.z());
  return {-z.y() * theta / s, z.x() * theta / s};
}

// d f / d x_k by central differences with a step so small, and so many digits, that the result is exact in
// double.
template <class Function>
auto exact_derivative(const Function& f, const ExactVector3& x, int k) {
  const Exact step("1e-25");
  ExactVector3 above = x, below = x;
  above[k] += step;
  below[k] -= step;
  return ((f(above) - f(below)) / (2 * step)).eval();
}

// Largest absolute difference of the entries.
template <class A, class B>
double largest_error(const Eigen::MatrixBase<A>& value, const Eigen::MatrixBase<B>& exact) {
  return static_cast<double>(
      (value.template cast<Exact>() - exact.template cast<Exact>()).cwiseAbs().maxCoeff());
}

}  // namespace patchlab::test
