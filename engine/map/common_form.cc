#include "engine/map/common_form.h"

#include <Eigen/Geometry>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

namespace patchlab {
namespace {

// Derivatives by (k3, w, t).
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 9, 1>>;
using DualVector = Eigen::Matrix<Dual, 3, 1>;
using DualMatrix = Eigen::Matrix<Dual, 3, 3>;

Dual variable(double value, int index) { return Dual(value, 9, index); }

struct DualQuadric {
  DualMatrix A;
  DualVector b;
  Dual c;
};

// f of Eq. (37) in the plane's coordinates v: q_patch = R(w)' (a + M v - t) near w = t = 0.
DualQuadric quadric_in_plane(const Patch& patch, const Pose& world_from_plane) {
  const Pose pose = world_from_patch(patch);
  const Vector3d a = apply_inverse(pose, world_from_plane.t), kappa = k3(patch);
  const Matrix3d M = axes(patch).transpose() * exp_map(world_from_plane.r);
  DualVector k, w, t;
  for (int i = 0; i < 3; ++i) {
    k[i] = variable(kappa[i], i);
    w[i] = variable(0.0, 3 + i);
    t[i] = variable(0.0, 6 + i);
  }
  const DualMatrix R_t =
      (DualMatrix() << Dual(1), w.z(), -w.y(), -w.z(), Dual(1), w.x(), w.y(), -w.x(), Dual(1)).finished();
  const DualMatrix N = R_t * M.cast<Dual>();
  const DualVector q0 = R_t * (a.cast<Dual>() - t);
  DualMatrix KN = N;
  for (int i = 0; i < 3; ++i) KN.row(i) *= k[i];
  const DualVector g = k.cwiseProduct(q0) - DualVector(Dual(0), Dual(0), Dual(1));  // half of Eq. (39)
  return {N.transpose() * KN, Dual(2) * (N.transpose() * g), q0.dot(k.cwiseProduct(q0)) - Dual(2) * q0.z()};
}

template <int size>
CommonForm<size> form_of(const Patch& patch, const Eigen::Matrix<Dual, size, 1>& entries) {
  const PatchTypeRow& type = *patch.type;
  CommonForm<size> form;
  Eigen::Matrix<double, size, 9> J;
  for (int i = 0; i < size; ++i) {
    form.value[i] = entries[i].value();
    J.row(i) = entries[i].derivatives().transpose();
  }
  form.J_wt = J.template rightCols<6>();
  form.J_local.setZero(size, type.size());
  form.J_local.middleCols(type.curvature_at(), type.curvature_size) = J.template leftCols<3>() * type.B;
  form.J_local.middleCols(type.rotation_at(), type.rotation_size) = J.middleCols(3, type.rotation_size);
  form.J_local.template rightCols<3>() = J.template rightCols<3>();
  return form;
}

}  // namespace

std::optional<SurfaceJet> surface_jet(const Patch& patch, const Pose& world_from_plane) {
  const DualQuadric f = quadric_in_plane(patch, world_from_plane);
  // A_zz h^2 + b_z h + c = 0; the root nearest the plane, with the normal towards +z: b_z < 0.
  const Dual discriminant = f.b.z() * f.b.z() - Dual(4) * f.A(2, 2) * f.c;
  if (!(discriminant.value() > 0.0) || !(f.b.z().value() < 0.0)) return std::nullopt;
  const Dual h = Dual(2) * f.c / (sqrt(discriminant) - f.b.z());
  const DualVector g = Dual(2) * h * f.A.col(2) + f.b;
  const Dual s_x = -g.x() / g.z(), s_y = -g.y() / g.z();
  Eigen::Matrix<Dual, 3, 2> D;
  D << Dual(1), Dual(0), Dual(0), Dual(1), s_x, s_y;
  const Eigen::Matrix<Dual, 2, 2> H = (Dual(-2) / g.z()) * (D.transpose() * f.A * D);
  return form_of<jet_size>(
      patch, (Eigen::Matrix<Dual, jet_size, 1>() << h, s_x, s_y, H(0, 0), H(0, 1), H(1, 1)).finished());
}

SurfaceQuadric surface_quadric(const Patch& patch, const Pose& world_from_plane) {
  const DualQuadric f = quadric_in_plane(patch, world_from_plane);
  Eigen::Matrix<Dual, quadric_size, 1> entries;
  entries << f.A(0, 0), f.A(0, 1), f.A(0, 2), f.A(1, 1), f.A(1, 2), f.A(2, 2), f.b, f.c;
  return form_of<quadric_size>(patch, entries);
}

Matrix6d J_wt_pose(const Pose& a_from_b, const Patch& patch_a) {
  const Matrix3d R_a_t = axes(patch_a).transpose(), Jl = left_jacobian(a_from_b.r);
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_a_t * Jl;
  J.bottomLeftCorner<3, 3>() = -R_a_t * skew(centre(patch_a) - a_from_b.t) * Jl;
  J.bottomRightCorner<3, 3>() = R_a_t;
  return J;
}

CovJet cov_unseen_curvature(const Patch& patch, const Vector2d& u) {
  CovJet cov = CovJet::Zero();
  const PatchTypeRow& type = *patch.type;
  if (!patch.covariance_local || type.curvature_size == 2) return cov;
  const int at = type.rotation_at();
  const auto var_tilt = patch.covariance_local->diagonal().segment<2>(at);  // about x: slope along y
  const bool rectangular = type.boundary == BoundaryType::rectangle;
  const Vector2d m2 = extent(boundary(patch)).array().square() / (rectangular ? 3.0 : 4.0);  // mean x^2, y^2
  // Variances that a fit of uniform points would give H_xx, H_yy, H_xy: those of the slopes over the spread
  // of x^2/2, y^2/2 and xy about their means, by the moments of an ellipse or a rectangle.
  const double square = rectangular ? 0.2 : 0.25, cross = rectangular ? 1.0 : 2.0 / 3.0;
  const double var_xx = var_tilt.y() / (square * m2.x()), var_yy = var_tilt.x() / (square * m2.y());
  const double var_xy = 0.5 * (var_tilt.y() / m2.y() + var_tilt.x() / m2.x()) / cross;
  // A fit that leaves (H_xx, H_xy, H_yy) out shifts the height by the mean of what they bend.
  const auto add = [&](double xx, double xy, double yy, double variance) {
    const double bent = xx * u.x() * u.x() + 2.0 * xy * u.x() * u.y() + yy * u.y() * u.y();
    Eigen::Matrix<double, jet_size, 1> direction;
    direction << 0.5 * (bent - xx * m2.x() - yy * m2.y()), xx * u.x() + xy * u.y(), xy * u.x() + yy * u.y(),
        xx, xy, yy;
    cov += variance * direction * direction.transpose();
  };
  const bool circular = type.revolute() && type.curvature_size == 1;
  if (circular) {
    add(1.0, 0.0, -1.0, 0.25 * (var_xx + var_yy));
    add(0.0, 1.0, 0.0, var_xy);
  } else {
    add(1.0, 0.0, 0.0, var_xx);  // along the axis of a cylinder, too
    if (type.curvature_size == 0) {
      add(0.0, 0.0, 1.0, var_yy);
      add(0.0, 1.0, 0.0, var_xy);
    }
  }
  return cov;
}

PatchMatrix cov_local_or_zero(const Patch& patch) {
  const auto cov = local_covariance(patch);
  return cov ? *cov : PatchMatrix(PatchMatrix::Zero(patch.type->size(), patch.type->size()));
}

Pose plane_at(const Vector3d& point, const Vector3d& normal, const Vector3d& along) {
  const Vector3d z = normal.normalized();
  Vector3d x = along - z * z.dot(along);
  if (x.norm() < 1e-6) x = z.unitOrthogonal();
  x.normalize();
  Matrix3d R;
  R << x, z.cross(x), z;
  return {log_map(R), point};
}

}  // namespace patchlab
