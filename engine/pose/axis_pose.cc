#include "engine/pose/axis_pose.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlab {
namespace {

using std::numbers::pi;

// The swing of a rotation: h and g are the sine and cosine of theta_xy / 2, r_xy = theta_xy m.
struct Swing {
  double h, g, theta;
  Vector2d m;  // unit; zero where theta is
};

Swing swing(const Vector3d& r) {
  const Vector3d r_c = canonical(r).r;
  const double t = std::hypot(r_c.x(), r_c.y(), r_c.z());
  const double w = std::max(std::cos(0.5 * t), std::cos(0.5 * pi));  // rounding must not turn it negative
  const Vector3d v = t == 0.0 ? Vector3d::Zero() : Vector3d(r_c / t * std::sin(0.5 * t));
  const double h = std::hypot(v.x(), v.y()), g = std::hypot(w, v.z());
  if (h == 0.0) return {0.0, g, 0.0, Vector2d::Zero()};
  const double c = w / g, s = v.z() / g;
  const double x = v.x() / h, y = v.y() / h;
  return {h, g, 2.0 * std::atan2(h, g), {c * x - s * y, s * x + c * y}};
}

// 1 - theta cot theta; near pi the cotangent comes from the half angles.
double one_minus_theta_cot(const Swing& s) {
  const double t = s.theta, x = t * t;
  if (t < 0.125) {
    return x * (1.0 / 3 + x * (1.0 / 45 + x * (2.0 / 945 + x * (1.0 / 4725 + x * (2.0 / 93555)))));
  }
  return 1.0 - t * (s.g - s.h) * (s.g + s.h) / (2.0 * s.g * s.h);
}

Vector2d perpendicular(const Vector2d& v) { return {-v.y(), v.x()}; }  // z x v

// I + factor m' m'^T, with m' perpendicular to r_xy.
Matrix2d stretched_across(const Vector2d& r_xy, double factor) {
  const Vector2d across = perpendicular(r_xy) / std::hypot(r_xy.x(), r_xy.y());
  return Matrix2d::Identity() + factor * across * across.transpose();
}

}  // namespace

Vector2d r_xy(const Vector3d& r) {
  const Swing s = swing(r);
  return s.theta * s.m;  // Eq. (8), errata section 4
}

Matrix23d J_r_xy_r(const Vector3d& r) {
  const Swing s = swing(r);
  const Vector2d across = perpendicular(s.m);
  Matrix23d J;  // Eq. (45), errata section 4
  J.leftCols<2>() = Matrix2d::Identity() - one_minus_theta_cot(s) * across * across.transpose();
  J.col(2) = s.theta * across;
  return J * left_jacobian(r);
}

Matrix2d J_r_xy_tilt(const Vector2d& r_xy) {
  const double theta = std::hypot(r_xy.x(), r_xy.y());
  if (theta == 0.0) return Matrix2d::Identity();
  return stretched_across(r_xy, theta / std::sin(theta) - 1.0);
}

Matrix2d J_tilt_r_xy(const Vector2d& r_xy) {
  const double theta = std::hypot(r_xy.x(), r_xy.y());
  if (theta == 0.0) return Matrix2d::Identity();
  return stretched_across(r_xy, std::sin(theta) / theta - 1.0);
}

bool near_singular(const Vector2d& r_xy, const Matrix2d& cov_tilt) {
  const Eigen::SelfAdjointEigenSolver<Matrix2d> solver(cov_tilt, Eigen::EigenvaluesOnly);
  const double sigma = std::sqrt(std::max(0.0, solver.eigenvalues()[1]));
  return pi - std::hypot(r_xy.x(), r_xy.y()) < std::max(1e-6, 20.0 * sigma);
}

Matrix56d J_axis_pose(const Pose& pose) {
  Matrix56d J = Matrix56d::Zero();  // Eq. (43)
  J.topLeftCorner<2, 3>() = J_r_xy_r(pose.r);
  J.bottomRightCorner<3, 3>() = Matrix3d::Identity();
  return J;
}

}  // namespace patchlab
