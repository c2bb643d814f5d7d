#include "engine/patch/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace patchlab {
namespace {

using std::numbers::pi;

bool round(const Boundary& boundary) {
  return boundary.type == BoundaryType::ellipse || boundary.type == BoundaryType::circle;
}

// d_x and d_y of an ellipse, a circle or a rectangle.
Vector2d radii(const Boundary& boundary) {
  return {boundary.d[0], boundary.d[boundary.type == BoundaryType::circle ? 0 : 1]};
}

// phi_i of Eq. (21), i = 0..3.
double diagonal_angle(int i, double gamma) {
  return std::array{gamma, pi - gamma, pi + gamma, -gamma}[static_cast<std::size_t>(i)];
}

using VertexJacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 5>;

// d v_i / d d of Eqs. (18) and (21).
VertexJacobian J_vertex(const Boundary& boundary, const Vector2d& v, int i) {
  if (boundary.type == BoundaryType::rectangle) {
    VertexJacobian J = VertexJacobian::Zero(2, 2);
    J(0, 0) = i == 0 || i == 3 ? 1.0 : -1.0;
    J(1, 1) = i < 2 ? 1.0 : -1.0;
    return J;
  }
  const double phi = diagonal_angle(i, boundary.d[4]);
  const double turn = i % 2 == 0 ? 1.0 : -1.0;  // d phi_i / d gamma
  VertexJacobian J = VertexJacobian::Zero(2, 5);
  J.col(i) << std::cos(phi), std::sin(phi);
  J.col(4) = turn * Vector2d(-v.y(), v.x());
  return J;
}

// Outward unit normal of the edge from vertex i to the next, zero where the edge has no length.
Vector2d edge_normal(const std::array<Vector2d, 4>& v, int i) {
  const Vector2d edge = v[static_cast<std::size_t>((i + 1) % 4)] - v[static_cast<std::size_t>(i % 4)];
  return Vector2d(edge.y(), -edge.x()).normalized();
}

Vector2d polygon_outward(const std::array<Vector2d, 4>& v, int i, bool at_corner) {
  const Vector2d own = edge_normal(v, i);
  if (!at_corner && own != Vector2d::Zero()) return own;
  return (own + edge_normal(v, i + 3) + (own == Vector2d::Zero() ? edge_normal(v, i + 1) : Vector2d::Zero()))
      .normalized();
}

OutlinePoint round_outline_point(const Boundary& boundary, double s) {
  const Vector2d d = radii(boundary), direction(std::cos(2.0 * pi * s), std::sin(2.0 * pi * s));
  OutlinePoint point{d.cwiseProduct(direction), {}, direction.cwiseQuotient(d).normalized()};
  if (boundary.type == BoundaryType::circle) {
    point.J_u_d = direction;
  } else {
    point.J_u_d = direction.asDiagonal().toDenseMatrix();
  }
  return point;
}

}  // namespace

std::array<Vector2d, 4> vertices(const Boundary& boundary) {
  if (boundary.type == BoundaryType::rectangle) {
    const double x = boundary.d[0], y = boundary.d[1];
    return {Vector2d(x, y), Vector2d(-x, y), Vector2d(-x, -y), Vector2d(x, -y)};  // Eq. (18)
  }
  std::array<Vector2d, 4> v;
  for (int i = 0; i < 4; ++i) {
    const double phi = diagonal_angle(i, boundary.d[4]);
    v[static_cast<std::size_t>(i)] = boundary.d[i] * Vector2d(std::cos(phi), std::sin(phi));  // Eq. (21)
  }
  return v;
}

double boundary_function(const Vector2d& u, const Boundary& boundary) {
  if (round(boundary)) return u.cwiseQuotient(radii(boundary)).squaredNorm() - 1.0;  // Eq. (17)
  const std::array<Vector2d, 4> v = vertices(boundary);
  double q = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    const Vector2d normal = edge_normal(v, i);
    if (normal == Vector2d::Zero()) continue;
    q = std::max(q, (u - v[static_cast<std::size_t>(i)]).dot(normal));  // Eqs. (19), (20)
  }
  return q;
}

bool contains(const Boundary& boundary, const Vector2d& u) { return boundary_function(u, boundary) <= 0.0; }

double area(const Boundary& boundary) {
  const BoundaryVector& d = boundary.d;
  switch (boundary.type) {
    case BoundaryType::ellipse:
      return pi * d[0] * d[1];
    case BoundaryType::circle:
      return pi * d[0] * d[0];
    case BoundaryType::rectangle:
      return 4.0 * d[0] * d[1];
    case BoundaryType::convex_quad:
      return 0.5 * (d[0] + d[2]) * (d[1] + d[3]) * std::sin(2.0 * d[4]);
  }
  return 0.0;
}

std::vector<Vector2d> outline(const Boundary& boundary, int count) {
  const int points = round(boundary) ? std::max(count, 3) : 4 * std::max((count + 3) / 4, 1);
  std::vector<Vector2d> curve;
  for (int i = 0; i < points; ++i) {
    curve.push_back(outline_point(boundary, static_cast<double>(i) / points).u);
  }
  return curve;
}

OutlinePoint outline_point(const Boundary& boundary, double s) {
  if (round(boundary)) return round_outline_point(boundary, s);
  const std::array<Vector2d, 4> v = vertices(boundary);
  const int i = std::clamp(static_cast<int>(4.0 * s), 0, 3), j = (i + 1) % 4;
  const Vector2d &from = v[static_cast<std::size_t>(i)], &to = v[static_cast<std::size_t>(j)];
  const double along = 4.0 * s - i;
  return {(1.0 - along) * from + along * to,
          (1.0 - along) * J_vertex(boundary, from, i) + along * J_vertex(boundary, to, j),
          polygon_outward(v, i, along == 0.0)};
}

Vector2d extent(const Boundary& boundary) {
  if (boundary.type != BoundaryType::convex_quad) return radii(boundary);
  Vector2d largest = Vector2d::Zero();
  for (const Vector2d& v : vertices(boundary)) largest = largest.cwiseMax(v.cwiseAbs());
  return largest;
}

}  // namespace patchlab
