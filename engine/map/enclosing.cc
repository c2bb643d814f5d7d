#include "engine/map/enclosing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/map/shapes_around.h"

namespace patchlab {
namespace {

constexpr int outline_points = 32;

// The outlines of what was seen, in the patch's frame.
std::vector<Vector3d> outlines_in(const Patch& patch, std::span<const Patch> seen) {
  const Pose pose = world_from_patch(patch);
  std::vector<Vector3d> out;
  for (const Patch& one : seen) {
    const bool quad = one.type->boundary == BoundaryType::convex_quad;
    for (const Vector2d& u : outline(boundary(one), quad ? 4 : outline_points)) {
      out.push_back(apply_inverse(pose, apply(world_from_patch(one), surface_point(u, k3(one)))));
    }
  }
  return out;
}

std::vector<Vector2d> flat(const std::vector<Vector3d>& points) {
  std::vector<Vector2d> out;
  for (const Vector3d& q : points) out.push_back(q.head<2>());
  return out;
}

Matrix3d about_z(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }

Vector3d on_plane(const Vector2d& u) { return {u.x(), u.y(), 0.0}; }

Patch with_bound(Patch patch, const BoundaryVector& d) {
  patch.parameters.head(patch.type->boundary_size) = d;
  return patch;
}

double farthest(const std::vector<Vector2d>& points) {
  double d = 0.0;
  for (const Vector2d& u : points) d = std::max(d, u.norm());
  return d;
}

Patch enclosed_turned(const Patch& patch, const TurnedShape& shape) {
  return with_bound(described_anew(patch, about_z(shape.angle), on_plane(shape.centre)), shape.d);
}

// Where the diagonals meet, x halfway between the first and the last vertex, Eq. (21).
Patch enclosed_quad(const Patch& patch, const std::array<Vector2d, 4>& v) {
  const Eigen::ParametrizedLine<double, 2> diagonal = Eigen::ParametrizedLine<double, 2>::Through(v[0], v[2]);
  const Vector2d middle = diagonal.intersectionPoint(Eigen::Hyperplane<double, 2>::Through(v[1], v[3]));
  const Vector2d first = (v[0] - v[2]).normalized(), last = (v[3] - v[1]).normalized(),
                 x = (first + last).normalized();
  BoundaryVector d(5);
  for (std::size_t i = 0; i < 4; ++i) d[static_cast<Eigen::Index>(i)] = (v[i] - middle).norm();
  d[4] = 0.5 * std::acos(std::clamp(first.dot(last), -1.0, 1.0));
  return with_bound(described_anew(patch, about_z(std::atan2(x.y(), x.x())), on_plane(middle)), d);
}

Patch enclosed_plane(const Patch& patch, const std::vector<Vector3d>& points) {
  const std::vector<Vector2d> hull = convex_hull(flat(points));
  switch (patch.type->boundary) {
    case BoundaryType::circle: {
      std::vector<Vector3d> corners;
      for (const Vector2d& u : hull) corners.push_back(on_plane(u));
      const Vector2d middle = ball_centre(corners).head<2>();
      double d = 0.0;
      for (const Vector2d& u : hull) d = std::max(d, (u - middle).norm());
      return with_bound(described_anew(patch, Matrix3d::Identity(), on_plane(middle)),
                        BoundaryVector::Constant(1, d));
    }
    case BoundaryType::ellipse:
      return enclosed_turned(patch, smallest_ellipse(hull));
    case BoundaryType::rectangle:
      return enclosed_turned(patch, smallest_rectangle(hull));
    case BoundaryType::convex_quad:
      break;
  }
  if (const auto quad = smallest_quad(hull)) return enclosed_quad(patch, *quad);
  const TurnedShape box = smallest_rectangle(hull);
  BoundaryVector d = BoundaryVector::Constant(5, box.d.norm());
  d[4] = std::atan2(box.d.y(), box.d.x());
  return with_bound(described_anew(patch, about_z(box.angle), on_plane(box.centre)), d);
}

// Points as seen from the centre (z = 1/kappa): the smallest cap turned to the apex.
Patch enclosed_sphere(const Patch& patch, const std::vector<Vector3d>& points) {
  const double kappa = curvatures(patch)[0];
  const Vector3d middle(0.0, 0.0, 1.0 / kappa);
  std::vector<Vector3d> towards;
  for (const Vector3d& q : points) towards.push_back((q - middle).normalized());
  const Vector3d axis = -ball_centre(towards).normalized() * (kappa > 0.0 ? 1.0 : -1.0);
  const Matrix3d Q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
  double d = 0.0;
  for (const Vector3d& q : towards) {
    const double c = std::abs(axis.dot(q));
    d = std::max(d, std::sqrt(std::max(0.0, 1.0 - c * c)) / std::abs(kappa));
  }
  return with_bound(described_anew(patch, Q, middle - Q.col(2) / kappa), BoundaryVector::Constant(1, d));
}

// Slid along the axis and rolled about it to the middle of what was seen.
Patch enclosed_cylinder(const Patch& patch, const std::vector<Vector3d>& points) {
  const double kappa = curvatures(patch)[0];
  Vector2d low = Vector2d::Constant(1e300), high = -low;  // (x, angle)
  for (const Vector3d& q : points) {
    const Vector2d at(q.x(), std::atan2(kappa * q.y(), 1.0 - kappa * q.z()));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Vector2d half = 0.5 * (high - low), mid = 0.5 * (high + low);
  const Matrix3d Q = Eigen::AngleAxisd(mid.y(), Vector3d::UnitX()).toRotationMatrix();
  const Vector3d p = Vector3d(mid.x(), 0.0, 1.0 / kappa) - Q.col(2) / kappa;
  const double d_y = std::sin(std::min(half.y(), 0.5 * std::numbers::pi)) / std::abs(kappa);
  return with_bound(described_anew(patch, Q, p), Vector2d(half.x(), d_y));
}

Patch enclosed_trough(const Patch& patch, const std::vector<Vector3d>& points) {
  double low = points.front().x(), high = low, d_y = 0.0;
  for (const Vector3d& q : points) {
    low = std::min(low, q.x());
    high = std::max(high, q.x());
    d_y = std::max(d_y, std::abs(q.y()));
  }
  return with_bound(described_anew(patch, Matrix3d::Identity(), Vector3d(0.5 * (low + high), 0.0, 0.0)),
                    Vector2d(0.5 * (high - low), d_y));
}

Patch enclosed(const Patch& patch, const std::vector<Vector3d>& points) {
  switch (patch.type->surface) {
    case SurfaceType::plane:
      return enclosed_plane(patch, points);
    case SurfaceType::sphere:
      return enclosed_sphere(patch, points);
    case SurfaceType::circular_cylinder:
      return enclosed_cylinder(patch, points);
    case SurfaceType::cylindric_paraboloid:
      return enclosed_trough(patch, points);
    case SurfaceType::circular_paraboloid:
      return with_bound(patch, BoundaryVector::Constant(1, farthest(flat(points))));
    case SurfaceType::elliptic_paraboloid:
    case SurfaceType::hyperbolic_paraboloid:
      break;
  }
  return with_bound(patch, smallest_centred_ellipse(flat(points)));
}

// Of the bound: the largest variances of what was seen by the same kind of bound, none joined to the surface.
PatchMatrix with_bound_variances(const Patch& patch, std::span<const Patch> seen) {
  const int size = patch.type->boundary_size;
  PatchMatrix cov = *patch.covariance_local;
  PatchVector variance = PatchVector::Zero(size);
  for (const Patch& one : seen) {
    if (one.type->boundary != patch.type->boundary || !one.covariance_local) continue;
    variance = variance.cwiseMax(PatchVector(one.covariance_local->diagonal().head(size)));
  }
  cov.topRows(size).setZero();
  cov.leftCols(size).setZero();
  cov.diagonal().head(size) = variance;
  return cov;
}

}  // namespace

Patch described_anew(const Patch& patch, const Matrix3d& Q, const Vector3d& p) {
  const PatchTypeRow& type = *patch.type;
  const Matrix3d R = axes(patch) * Q, Q_t = Q.transpose();
  const Vector3d c = apply(world_from_patch(patch), p);
  if (!patch.covariance_local) return make_patch(type, boundary(patch), curvatures(patch), R, c);
  const int at = type.rotation_at(), size = type.rotation_size;
  PatchMatrix J = PatchMatrix::Identity(type.size(), type.size());
  J.block(at, at, size, size) = Q_t.topLeftCorner(size, size);
  J.block(type.position_at(), at, 3, size) = (-Q_t * skew(p)).leftCols(size);
  J.bottomRightCorner<3, 3>() = Q_t;
  if (type.surface == SurfaceType::sphere || type.surface == SurfaceType::circular_cylinder) {
    const double kappa = curvatures(patch)[0];  // the centre stays 1/kappa from either apex
    J.block<3, 1>(type.position_at(), type.curvature_at()) =
        Q_t * (Q.col(2) - Vector3d::UnitZ()) / (kappa * kappa);
  }
  return make_patch(type, boundary(patch), curvatures(patch), R, c, carried(J, *patch.covariance_local));
}

Patch with_enclosing_bound(const Patch& patch, std::span<const Patch> seen) {
  Patch out = enclosed(patch, outlines_in(patch, seen));
  const bool half =
      out.type->surface == SurfaceType::sphere || out.type->surface == SurfaceType::circular_cylinder;
  if (half) {  // as far as the equator
    double& d = out.parameters[out.type->boundary_size - 1];
    d = std::min(d, 1.0 / std::abs(curvatures(out)[0]));
  }
  std::optional<PatchMatrix> cov;
  if (out.covariance_local) cov = with_bound_variances(out, seen);
  return conventional(make_patch(*out.type, boundary(out), curvatures(out), axes(out), centre(out), cov));
}

}  // namespace patchlab
