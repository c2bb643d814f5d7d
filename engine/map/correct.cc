#include "engine/map/correct.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/map/common_form.h"

namespace patchlab {
namespace {

using Eigen::MatrixXd;
using QuadricVector = Eigen::Matrix<double, quadric_size, 1>;

constexpr int newton_steps = 12;
constexpr double settled_step = 1e-12;  // in units of the patch

// An elliptic paraboloid whose smaller kappa crosses zero is a hyperbolic one, and the other way round.
const PatchTypeRow& type_by_signs(const PatchTypeRow& type, const Eigen::VectorXd& kappa) {
  if (kappa.size() != 2) return type;
  const bool same = kappa[0] * kappa[1] > 0.0;
  return *find_patch_type(same ? SurfaceType::elliptic_paraboloid : SurfaceType::hyperbolic_paraboloid,
                          type.boundary);
}

// The principal axes of diag(kappa) + (step_x, H_xy; H_xy, step_y): their turn, and kappa along them.
struct Principal {
  double turn;
  Vector2d kappa;
};
Principal principal(const Vector2d& before, const Vector2d& step, double H_xy) {
  const Vector2d H = before + step;
  const double sign = before.x() >= before.y() ? 1.0 : -1.0;
  const double turn = 0.5 * std::atan2(2.0 * sign * H_xy, sign * (H.x() - H.y()));
  const double c = std::cos(turn), s = std::sin(turn), mixed = 2.0 * c * s * H_xy;
  return {turn, {c * c * H.x() + s * s * H.y() + mixed, s * s * H.x() + c * c * H.y() - mixed}};
}

// By a step of the local chart; the spin of a surface with two curvatures by the H_xy that it makes.
Patch moved(const Patch& patch, const PatchVector& x) {
  const PatchTypeRow& type = *patch.type;
  Eigen::VectorXd kappa = curvatures(patch) + x.segment(type.curvature_at(), type.curvature_size);
  Vector3d w = Vector3d::Zero();
  w.head(type.rotation_size) = x.segment(type.rotation_at(), type.rotation_size);
  Matrix3d turn = exp_map(w);
  if (type.curvature_size == 2) {
    const Vector2d before = curvatures(patch);
    const Principal now = principal(before, kappa - before, (before.x() - before.y()) * w.z());
    kappa = now.kappa;
    turn = exp_map({w.x(), w.y(), 0.0}) * exp_map({0.0, 0.0, now.turn});
  }
  const Boundary bound{type.boundary, boundary(patch).d + x.head(type.boundary_size)};
  return make_patch(type_by_signs(type, kappa), bound, kappa, axes(patch) * turn,
                    centre(patch) + axes(patch) * x.tail<3>());
}

// Units of size L that make quadric and chart dimensionless.
struct Units {
  QuadricVector quadric;
  PatchVector chart;
};
Units units_of(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  const double L = extent(boundary(patch)).maxCoeff();
  Units units{QuadricVector::Ones(), PatchVector::Ones(type.size())};
  units.quadric.head<6>().setConstant(L);
  units.quadric[9] = 1.0 / L;
  units.chart.segment(type.curvature_at(), type.curvature_size).setConstant(1.0 / L);
  units.chart.tail<3>().setConstant(L);
  return units;
}

// Pseudo-inverse over the `rank` strongest directions.
MatrixXd pseudo_inverse(const MatrixXd& J, int rank) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(J.transpose() * J);
  const MatrixXd V = solver.eigenvectors().rightCols(rank);
  return V * solver.eigenvalues().tail(rank).cwiseMax(1e-300).cwiseInverse().asDiagonal() * V.transpose() *
         J.transpose();
}

MatrixXd jacobian(const Patch& patch, const Pose& plane, const Units& units) {
  return units.quadric.asDiagonal() * surface_quadric(patch, plane).J_local * units.chart.asDiagonal();
}

// From the chart of the patch before to that of the patch after, where both describe one frame: w and t turn
// with the axes.
MatrixXd J_turned(const Patch& before, const Patch& after) {
  const PatchTypeRow& type = *before.type;
  const Matrix3d turn = axes(after).transpose() * axes(before);
  MatrixXd J = MatrixXd::Identity(type.size(), type.size());
  J.block(type.rotation_at(), type.rotation_at(), type.rotation_size, type.rotation_size) =
      turn.topLeftCorner(type.rotation_size, type.rotation_size);
  J.bottomRightCorner<3, 3>() = turn;
  return J;
}

}  // namespace

SurfaceDof surface_dof(const PatchTypeRow& type) {
  switch (type.surface) {
    case SurfaceType::plane:
      return {3, 3};
    case SurfaceType::sphere:
      return {4, 4};
    case SurfaceType::circular_cylinder:
      return {5, 5};
    case SurfaceType::cylindric_paraboloid:
      return {6, 5};
    case SurfaceType::circular_paraboloid:
      return {6, 4};
    case SurfaceType::elliptic_paraboloid:
    case SurfaceType::hyperbolic_paraboloid:
      break;
  }
  return {8, 6};
}

Patch corrected(const Patch& patch, const PatchVector& x, const PatchMatrix& P, const Pose& plane) {
  const Units units = units_of(patch);
  const int dof = surface_dof(*patch.type).all;
  const MatrixXd J_before = jacobian(patch, plane, units);
  const PatchVector step = x.cwiseQuotient(units.chart);
  const QuadricVector target =
      units.quadric.cwiseProduct(surface_quadric(patch, plane).value) + QuadricVector(J_before * step);
  Patch now = moved(patch, x);
  MatrixXd J_inverse = pseudo_inverse(jacobian(now, plane, units), dof);
  for (int i = 0; i < newton_steps; ++i) {
    const QuadricVector off = target - units.quadric.cwiseProduct(surface_quadric(now, plane).value);
    const PatchVector more = J_inverse * off;
    now = moved(now, units.chart.cwiseProduct(more));
    J_inverse = pseudo_inverse(jacobian(now, plane, units), dof);
    if (more.norm() < settled_step) break;
  }
  const auto size = patch.type->size();
  const MatrixXd same = MatrixXd::Identity(size, size) - J_inverse * jacobian(now, plane, units);
  const PatchMatrix J =
      units.chart.asDiagonal() * (J_inverse * J_before) * units.chart.cwiseInverse().asDiagonal();
  const PatchMatrix J_same =
      units.chart.asDiagonal() * same * units.chart.cwiseInverse().asDiagonal() * J_turned(patch, now);
  return conventional(
      make_patch(*now.type, boundary(now), curvatures(now), axes(now), centre(now), carried(J + J_same, P)));
}

}  // namespace patchlab
