#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/patch/patch.h"

namespace patchlab {
namespace {

// One way to describe the same patch by other axes: R -> R Q, and linear maps of d and kappa. The local chart
// follows: R R(w) Q = R Q R(Q' w).
struct Relabelling {
  PatchVector d, kappa;
  PatchMatrix J_d, J_kappa;
  Matrix3d Q;
};

Patch relabelled(const Patch& patch, const Relabelling& by) {
  const PatchTypeRow& type = *patch.type;
  PatchMatrix J = PatchMatrix::Zero(type.size(), type.size());
  J.topLeftCorner(type.boundary_size, type.boundary_size) = by.J_d;
  J.block(type.curvature_at(), type.curvature_at(), type.curvature_size, type.curvature_size) = by.J_kappa;
  const Matrix3d Qt = by.Q.transpose();
  J.block(type.rotation_at(), type.rotation_at(), type.rotation_size, type.rotation_size) =
      Qt.topLeftCorner(type.rotation_size, type.rotation_size);
  J.bottomRightCorner<3, 3>() = Qt;
  std::optional<PatchMatrix> covariance = local_covariance(patch);
  if (covariance) covariance = carried(J, *covariance);
  return make_patch(type, {type.boundary, by.d}, by.kappa, axes(patch) * by.Q, centre(patch), covariance);
}

// Rows of the identity in the order given: new[i] = old[order[i]].
PatchMatrix permutation(std::initializer_list<int> order) {
  const auto n = static_cast<Eigen::Index>(order.size());
  PatchMatrix P = PatchMatrix::Zero(n, n);
  Eigen::Index row = 0;
  for (const int column : order) P(row++, column) = 1.0;
  return P;
}

PatchMatrix identity(int n) { return PatchMatrix::Identity(n, n); }

// The vertices of a quad in another order; the other boundaries keep their d.
PatchMatrix J_vertices(const PatchTypeRow& type, std::initializer_list<int> quad_order) {
  return type.boundary == BoundaryType::convex_quad ? permutation(quad_order) : identity(type.boundary_size);
}

Relabelling linear(const Patch& patch, const PatchMatrix& J_d, const PatchMatrix& J_kappa,
                   const Matrix3d& Q) {
  return {J_d * boundary(patch).d, J_kappa * curvatures(patch), J_d, J_kappa, Q};
}

bool wants_flip(const Patch& patch, const Vector3d& viewpoint) {
  const Vector3d z = axes(patch).col(2);
  const double towards = z.dot(viewpoint - centre(patch));
  if (towards != 0.0) return towards < 0.0;
  Eigen::Index largest = 0;
  z.cwiseAbs().maxCoeff(&largest);
  return z[largest] < 0.0;
}

bool wants_swap(const Patch& patch) {
  const BoundaryVector d = boundary(patch).d;
  if (patch.type->curvature_size == 2) {
    const Vector2d k = curvatures(patch);
    const double x = std::abs(k.x()), y = std::abs(k.y());
    return x > y || (x == y && k.x() > k.y());
  }
  if (patch.type->surface != SurfaceType::plane || patch.type->revolute()) return false;
  if (patch.type->boundary == BoundaryType::convex_quad) return d[4] > 0.25 * std::numbers::pi;
  return d[0] < d[1];
}

Vector3d half_turn_signs() { return {-1.0, -1.0, 1.0}; }

// The smaller |r|; on a tie the larger r_z, then r_x, then r_y. Of patches that are not revolute.
bool wants_half_turn(const Patch& patch) {
  constexpr double slack = 1e-12;
  const Vector3d r = world_from_patch(patch).r;
  const Vector3d r_turned = log_map(axes(patch) * half_turn_signs().asDiagonal());
  const double shorter = r.norm() - r_turned.norm();
  if (std::abs(shorter) > slack) return shorter > 0.0;
  for (const int i : {2, 0, 1}) {
    if (std::abs(r_turned[i] - r[i]) > slack) return r_turned[i] > r[i];
  }
  return false;
}

Patch with_canonical_rotation(const Patch& patch) {
  if (world_from_patch(patch).r.norm() <= std::numbers::pi) return patch;
  return make_patch(*patch.type, boundary(patch), curvatures(patch), axes(patch), centre(patch),
                    local_covariance(patch));
}

}  // namespace

Patch flip_normal(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  return relabelled(patch, linear(patch, J_vertices(type, {3, 2, 1, 0, 4}), -identity(type.curvature_size),
                                  Vector3d(1, -1, -1).asDiagonal()));
}

Patch half_turn(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  return relabelled(patch, linear(patch, J_vertices(type, {2, 3, 0, 1, 4}), identity(type.curvature_size),
                                  half_turn_signs().asDiagonal()));
}

Patch swap_axes(const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  Matrix3d quarter_turn;
  quarter_turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const PatchMatrix J_kappa = type.curvature_size == 2 ? permutation({1, 0}) : identity(type.curvature_size);
  if (type.boundary != BoundaryType::convex_quad) {
    return relabelled(patch, linear(patch, permutation({1, 0}), J_kappa, quarter_turn));
  }
  Relabelling by = linear(patch, permutation({1, 2, 3, 0, 4}), J_kappa, quarter_turn);
  by.d[4] = 0.5 * std::numbers::pi - by.d[4];
  by.J_d(4, 4) = -1.0;
  return relabelled(patch, by);
}

Patch conventional(const Patch& patch, const std::optional<Vector3d>& viewpoint) {
  Patch out = viewpoint && wants_flip(patch, *viewpoint) ? flip_normal(patch) : patch;
  if (wants_swap(out)) out = swap_axes(out);
  if (!out.type->revolute() && wants_half_turn(out)) out = half_turn(out);
  return with_canonical_rotation(out);
}

}  // namespace patchlab
