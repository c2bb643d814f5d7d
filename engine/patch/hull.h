// The convex hull of points in a plane, and the least ellipse about it.
#pragma once

#include <vector>

#include "engine/pose/axis_pose.h"

namespace patchlab {

// Counterclockwise, without points on its edges.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points);

struct TurnedShape {
  Vector2d centre;
  double angle;  // of its x axis
  Vector2d d;    // half extents along its axes
};
// Holds the hull; its area is within `tolerance` of the least (Khachiyan's algorithm). Precondition: three
// vertices or more.
TurnedShape smallest_ellipse(const std::vector<Vector2d>& hull, double tolerance = 1e-6);

}  // namespace patchlab
