// Numbers that carry their derivatives for everything a bounded patch is made from (engine/fit/moments.h).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "engine/fit/moments.h"

namespace patchlab {

using JointGradient = Eigen::Matrix<double, joint_size, 1>;
using Dual = Eigen::AutoDiffScalar<JointGradient>;
using Dual2 = Eigen::Matrix<Dual, 2, 1>;
using Dual3 = Eigen::Matrix<Dual, 3, 1>;

inline Dual variable(double at, int index) { return {at, joint_size, index}; }
inline Dual constant(double at) { return Dual(at, JointGradient::Zero()); }
inline Dual3 constant(const Vector3d& v) { return {constant(v[0]), constant(v[1]), constant(v[2])}; }

inline Dual dot(const Dual3& a, const Dual3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Dual3 cross(const Dual3& a, const Dual3& b) {
  return {Dual(a[1] * b[2] - a[2] * b[1]), Dual(a[2] * b[0] - a[0] * b[2]), Dual(a[0] * b[1] - a[1] * b[0])};
}
inline Dual3 scaled(const Dual3& a, const Dual& s) {
  return {Dual(a[0] * s), Dual(a[1] * s), Dual(a[2] * s)};
}
inline Dual3 sum(const Dual3& a, const Dual3& b) {
  return {Dual(a[0] + b[0]), Dual(a[1] + b[1]), Dual(a[2] + b[2])};
}
inline Dual3 difference(const Dual3& a, const Dual3& b) {
  return {Dual(a[0] - b[0]), Dual(a[1] - b[1]), Dual(a[2] - b[2])};
}
inline Dual3 normalised(const Dual3& a) { return scaled(a, Dual(1.0 / sqrt(dot(a, a)))); }
inline Dual3 turned(const Matrix3d& R, const Dual3& v) {
  Dual3 w;
  for (int i = 0; i < 3; ++i) w[i] = R(i, 0) * v[0] + R(i, 1) * v[1] + R(i, 2) * v[2];
  return w;
}

inline Vector3d value(const Dual3& v) { return {v[0].value(), v[1].value(), v[2].value()}; }
inline Eigen::Matrix<double, 3, joint_size> slope(const Dual3& v) {
  Eigen::Matrix<double, 3, joint_size> J;
  for (int i = 0; i < 3; ++i) J.row(i) = v[i].derivatives().transpose();
  return J;
}

}  // namespace patchlab
