// Smallest shapes around points of a plane.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace patchlab {

using Eigen::Vector2d;

// The convex hull, counterclockwise, without points on its edges.
std::vector<Vector2d> hull_around(std::vector<Vector2d> points);

// Centre of the smallest ball around points, to a thousandth of its radius (Badoiu and Clarkson).
Eigen::Vector3d ball_centre(const std::vector<Eigen::Vector3d>& points);

struct TurnedShape {
  Vector2d centre;
  double angle;  // of its x axis
  Vector2d d;    // half extents along its axes
};
TurnedShape smallest_rectangle(const std::vector<Vector2d>& hull);
TurnedShape smallest_ellipse(const std::vector<Vector2d>& hull);
// Of the ellipses about the origin along x and y.
Vector2d smallest_centred_ellipse(const std::vector<Vector2d>& points);
// Of the quadrilaterals with sides along those of the hull; nothing where none is closed.
std::optional<std::array<Vector2d, 4>> smallest_quad(const std::vector<Vector2d>& hull);

}  // namespace patchlab
