#include "engine/pose/rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

namespace patchlab {
namespace {

using std::numbers::pi;
constexpr double longest_canonical =
    pi * (1.0 + 1e-15);  // a vector of length pi must survive its own rounding

double length(const Vector3d& v) { return std::hypot(v.x(), v.y(), v.z()); }

double polynomial(double x, std::span<const double> coefficients) {
  double value = 0.0;
  for (std::size_t i = coefficients.size(); i-- > 0;) value = value * x + coefficients[i];
  return value;
}

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

// beta of Eq. (2) by the half angle (errata D7).
double coefficient_B(double t) {
  const double half = sinc(0.5 * t);
  return 0.5 * half * half;
}

// (t - sin t) / t^3.
double coefficient_C(double t) {
  static constexpr double series[] = {1.0 / 6,        -1.0 / 120,        1.0 / 5040,         -1.0 / 362880,
                                      1.0 / 39916800, -1.0 / 6227020800, 1.0 / 1307674368000};
  if (t < 0.5) return polynomial(t * t, series);
  return (t - std::sin(t)) / (t * t * t);
}

// (1 - (t/2) cot(t/2)) / t^2.
double coefficient_D(double t) {
  static constexpr double series[] = {1.0 / 12,      1.0 / 720,      1.0 / 30240,
                                      1.0 / 1209600, 1.0 / 47900160, 691.0 / 1307674368000};
  if (t < 0.25) return polynomial(t * t, series);
  const double half = 0.5 * t;
  return (1.0 - half * std::cos(half) / std::sin(half)) / (t * t);
}

Matrix3d second_order(const Vector3d& r, double first, double second) {
  const Matrix3d r_x = skew(r);
  return Matrix3d::Identity() + first * r_x + second * (r_x * r_x);
}

// The unit quaternion of R from its largest component (Shepperd), w >= 0. At w = 0 that component is
// positive.
Eigen::Quaterniond quaternion(const Matrix3d& R) {
  Eigen::Quaterniond q;
  int i = 0;
  const double largest = R.diagonal().maxCoeff(&i);
  if (R.trace() >= largest) {
    q.w() = 1.0 + R.trace();
    q.vec() << R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1);
  } else {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    q.w() = R(k, j) - R(j, k);
    q.vec()[i] = 1.0 + R(i, i) - R(j, j) - R(k, k);
    q.vec()[j] = R(j, i) + R(i, j);
    q.vec()[k] = R(k, i) + R(i, k);
  }
  q.coeffs() /= q.coeffs().stableNorm();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

// r scaled to the signed length `new_length`, which stands for the same rotation.
Reparametrised rescaled(const Vector3d& r, double old_length, double new_length) {
  const double s = new_length / old_length;
  const Vector3d n = r / old_length;
  return {s * r, s * Matrix3d::Identity() + (1.0 - s) * n * n.transpose()};
}

}  // namespace

Matrix3d skew(const Vector3d& v) {
  Matrix3d v_x;
  v_x << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return v_x;
}

Matrix3d exp_map(const Vector3d& r) {
  const double t = length(r);
  return second_order(r, sinc(t), coefficient_B(t));  // Eq. (2)
}

Vector3d log_map(const Matrix3d& R) {
  const Eigen::Quaterniond q = quaternion(R);
  const double s = length(q.vec());
  if (s < 1e-300) return 2.0 * q.vec();
  return q.vec() * (2.0 * std::atan2(s, q.w()) / s);
}

Matrix3d shortest_turn(const Vector3d& from, const Vector3d& to) {
  const Vector3d x = from.normalized(), cross = x.cross(to);
  const Vector3d across = cross - x * x.dot(cross);
  const Vector3d axis = across.isZero(0.0) ? x.unitOrthogonal() : Vector3d(across.normalized());
  return exp_map(std::atan2(cross.norm(), x.dot(to)) * axis);
}

Result<Matrix3d> nearest_rotation(const Matrix3d& R) {
  const double error = (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!R.allFinite() || !(error <= 1e-3)) {
    return Error{ErrorCode::unreadable,
                 "The matrix is no rotation: its columns are not orthonormal to 1e-3."};
  }
  if (R.determinant() < 0.0) {
    return Error{ErrorCode::unreadable, "The matrix is no rotation: its determinant is -1 (a reflection)."};
  }
  if (error <= 1e-9) return R;
  return Matrix3d(R * Eigen::SelfAdjointEigenSolver<Matrix3d>(R.transpose() * R).operatorInverseSqrt());
}

Matrix3d left_jacobian(const Vector3d& r) {
  const double t = length(r);
  return second_order(r, coefficient_B(t), coefficient_C(t));
}

Matrix3d right_jacobian(const Vector3d& r) { return left_jacobian(-r); }

Matrix3d left_jacobian_inverse(const Vector3d& r) { return second_order(r, -0.5, coefficient_D(length(r))); }

Matrix3d right_jacobian_inverse(const Vector3d& r) { return left_jacobian_inverse(-r); }

std::array<Matrix3d, 3> J_R_r(const Vector3d& r) {
  const Matrix3d R = exp_map(r), Jl = left_jacobian(r);
  return {skew(Jl.col(0)) * R, skew(Jl.col(1)) * R, skew(Jl.col(2)) * R};  // Eq. (44), errata section 2
}

Matrix3d J_Rv_r(const Vector3d& r, const Vector3d& v) { return -skew(exp_map(r) * v) * left_jacobian(r); }

Matrix3d J_Rtv_r(const Vector3d& r, const Vector3d& v) {
  return exp_map(r).transpose() * skew(v) * left_jacobian(r);
}

Reparametrised canonical(const Vector3d& r) {
  const double t = length(r);
  if (t <= longest_canonical) return {r, Matrix3d::Identity()};
  return rescaled(r, t, std::remainder(t, 2.0 * pi));
}

Reparametrised nearest_branch(const Vector3d& r, const Vector3d& reference) {
  const double t = length(r);
  if (t == 0.0) return {r, Matrix3d::Identity()};
  const double turns = std::round((reference.dot(r / t) - t) / (2.0 * pi));
  if (turns == 0.0) return {r, Matrix3d::Identity()};
  return rescaled(r, t, t + 2.0 * pi * turns);
}

}  // namespace patchlab
