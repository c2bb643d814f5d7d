// The convex hull of points in a plane, and the least shapes of each kind about it.
#pragma once

#include <vector>

#include "engine/fit/edge_quad.h"

namespace patchlab {

// Counterclockwise; the vertices of the hull only.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points);

// The rectangle of least area: one side lies on an edge of the hull. Precondition of all: three vertices or
// more.
EdgeVector rectangle_about(const std::vector<Vector2d>& hull);
// A quad of little area, found by dropping the hull's edges one by one.
EdgeVector quad_about(const std::vector<Vector2d>& hull);
double least_circle_area(const std::vector<Vector2d>& hull);   // Welzl's incremental construction
double least_ellipse_area(const std::vector<Vector2d>& hull);  // Khachiyan's, to 0.1 %

}  // namespace patchlab
