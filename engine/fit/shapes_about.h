// The least shapes of each kind about the convex hull of points (engine/patch/hull.h).
#pragma once

#include <vector>

#include "engine/fit/edge_quad.h"

namespace patchlab {

// The rectangle of least area: one side lies on an edge of the hull. Precondition of all: three vertices or
// more.
EdgeVector rectangle_about(const std::vector<Vector2d>& hull);
// A quad of little area, found by dropping the hull's edges one by one.
EdgeVector quad_about(const std::vector<Vector2d>& hull);
double least_circle_area(const std::vector<Vector2d>& hull);   // Welzl's incremental construction
double least_ellipse_area(const std::vector<Vector2d>& hull);  // to 0.1 %

}  // namespace patchlab
