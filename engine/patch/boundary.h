// The boundaries of Section III in the xy plane of the patch, Eqs. (17)-(21). d in metre, gamma in radian.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/pose/axis_pose.h"

namespace patchlab {

enum class BoundaryType { ellipse, circle, rectangle, convex_quad };

// Parameters in order: ellipse and rectangle (d_x, d_y), circle (d), convex quad (d_1, d_2, d_3, d_4, gamma).
using BoundaryVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 5, 1>;

struct Boundary {
  BoundaryType type = BoundaryType::circle;
  BoundaryVector d;
};

// Signed metric function: <= 0 inside and on the edge. Ellipse and circle: e of Eq. (17) (dimensionless);
// rectangle and quad: q of Eq. (19) with each line function divided by its edge length (m).
double boundary_function(const Vector2d& u, const Boundary& boundary);
bool contains(const Boundary& boundary, const Vector2d& u);
double area(const Boundary& boundary);  // of the projection on the xy plane, m^2

// The vertices v_1..v_4 counterclockwise, Eqs. (18), (21). Precondition: rectangle or convex quad.
std::array<Vector2d, 4> vertices(const Boundary& boundary);

// A closed curve counterclockwise (the first point is not repeated), with at least `count` points; the
// corners of rectangles and quads are among them.
std::vector<Vector2d> outline(const Boundary& boundary, int count);

// The outline point at fraction s in [0, 1) of the way round, its derivative for d (2 x n), and the outward
// unit normal of the curve (at a corner the mean of the two edges').
struct OutlinePoint {
  Vector2d u;
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 5> J_u_d;
  Vector2d outward;
};
OutlinePoint outline_point(const Boundary& boundary, double s);

// Half-extents of the smallest axis-aligned box around the outline: largest |x| and |y|.
Vector2d extent(const Boundary& boundary);

}  // namespace patchlab
