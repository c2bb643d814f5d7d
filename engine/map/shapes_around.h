// Smallest shapes around points, besides those of engine/patch/hull.h.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/patch/hull.h"

namespace patchlab {

// Centre of the smallest ball around points, to a thousandth of its radius (Badoiu and Clarkson).
Vector3d ball_centre(const std::vector<Vector3d>& points);

TurnedShape smallest_rectangle(const std::vector<Vector2d>& hull);
// Of the ellipses about the origin along x and y.
Vector2d smallest_centred_ellipse(const std::vector<Vector2d>& points);
// Of the quadrilaterals with sides along those of the hull; nothing where none is closed.
std::optional<std::array<Vector2d, 4>> smallest_quad(const std::vector<Vector2d>& hull);

}  // namespace patchlab
