#include "engine/patch/marginals.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/chi_square.h"

namespace patchlab {
namespace {

double standard_deviation(double variance) { return std::sqrt(std::max(0.0, variance)); }

Vector3d with_largest_positive(const Vector3d& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  return v[largest] < 0.0 ? Vector3d(-v) : v;
}

using ParameterRow = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 11>;

double sigma_of(const ParameterRow& J, const PatchMatrix& covariance) {
  return standard_deviation((J * covariance * J.transpose()).value());
}

}  // namespace

Matrix3d cov_centre(const Patch& patch) {
  const Matrix3d R = axes(patch);
  return R * patch.covariance_local->bottomRightCorner<3, 3>() * R.transpose();
}

Ellipsoid ellipsoid(const Vector3d& centre, const Matrix3d& covariance, double probability) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance);
  const double scale = ellipsoid_scale(probability, 3);
  Ellipsoid out{centre, {}, scale * solver.eigenvalues().reverse().unaryExpr(&standard_deviation)};
  out.axes.col(0) = with_largest_positive(solver.eigenvectors().col(2));
  out.axes.col(1) = with_largest_positive(solver.eigenvectors().col(1));
  out.axes.col(2) = out.axes.col(0).cross(out.axes.col(1));
  return out;
}

Ellipsoid centre_ellipsoid(const Patch& patch, double probability) {
  return ellipsoid(centre(patch), cov_centre(patch), probability);
}

NormalCone normal_cone(const Patch& patch, double probability) {
  const int at = patch.type->rotation_at();
  const Eigen::SelfAdjointEigenSolver<Matrix2d> solver(patch.covariance_local->block<2, 2>(at, at));
  const double scale = ellipsoid_scale(probability, 2);
  const Matrix3d R = axes(patch);
  NormalCone cone{centre(patch), R.col(2), {}, {}};
  for (int i = 0; i < 2; ++i) {
    cone.axes.col(i) = with_largest_positive(R.leftCols<2>() * solver.eigenvectors().col(1 - i));
    cone.half_angles[i] = std::min(scale * standard_deviation(solver.eigenvalues()[1 - i]), std::numbers::pi);
  }
  return cone;
}

double height_sigma(const Patch& patch, const Vector2d& u) {
  const PatchTypeRow& type = *patch.type;
  const Vector3d k = k3(patch), q = surface_point(u, k), g = gradient(q, k);
  ParameterRow J = ParameterRow::Zero(type.size());  // d f / d (local chart), method M2
  J.segment(type.curvature_at(), type.curvature_size) = q.cwiseProduct(q).transpose() * type.B;
  J.segment(type.rotation_at(), type.rotation_size) = g.cross(q).head(type.rotation_size).transpose();
  J.tail<3>() = -g.transpose();
  return sigma_of(J, *patch.covariance_local) / g.norm();
}

std::vector<BandPoint> outline_band(const Patch& patch, int count) {
  const PatchTypeRow& type = *patch.type;
  const Boundary bound = boundary(patch);
  const std::size_t points = outline(bound, count).size();
  std::vector<BandPoint> band;
  for (std::size_t i = 0; i < points; ++i) {
    const OutlinePoint at = outline_point(bound, static_cast<double>(i) / static_cast<double>(points));
    ParameterRow J = ParameterRow::Zero(type.size());
    J.head(type.boundary_size) = at.outward.transpose() * at.J_u_d;
    if (!type.revolute()) J[type.rotation_at() + 2] = at.outward.dot(Vector2d(-at.u.y(), at.u.x()));
    J.segment<2>(type.position_at()) = at.outward.transpose();
    band.push_back({at.u, at.outward, sigma_of(J, *patch.covariance_local)});
  }
  return band;
}

PatchVector sigmas(const PatchMatrix& covariance) {
  return covariance.diagonal().unaryExpr(&standard_deviation);
}

PatchMatrix correlation(const PatchMatrix& covariance) {
  const PatchVector inverse = sigmas(covariance).unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  return inverse.asDiagonal() * covariance * inverse.asDiagonal();
}

}  // namespace patchlab
