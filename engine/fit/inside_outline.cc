#include "engine/fit/inside_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlab {

bool is_round(const Boundary& bound) {
  return bound.type == BoundaryType::ellipse || bound.type == BoundaryType::circle;
}

InsideOutline::InsideOutline(const Boundary& bound) : round_(is_round(bound)) {
  if (round_) {
    radii_ = extent(bound);
    inverse_ = radii_.cwiseInverse();
    return;
  }
  const std::array<Vector2d, 4> corners = vertices(bound);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d a = corners[i], along = corners[(i + 1) % 4] - a;
    const Vector2d normal(along.y(), -along.x());
    const double side = normal.dot(a) < 0.0 ? -1.0 : 1.0;  // the origin is inside
    lines_[i] = {side * normal, side * normal.dot(a)};
  }
}

InsideOutline::Interval InsideOutline::across(double y) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  if (round_) {
    const double share = y * inverse_.y(), half = radii_.x() * std::sqrt(1.0 - share * share);
    return {-half, half};
  }
  Interval across{-far, far};
  for (const OuterLine& line : lines_) {
    const double rest = line.offset - line.normal.y() * y, x = rest / line.normal.x();
    if (line.normal.x() > 0.0) across.to = std::min(across.to, x);
    if (line.normal.x() < 0.0) across.from = std::max(across.from, x);
    if (line.normal.x() == 0.0 && rest < 0.0) return {far, -far};
  }
  return across;
}

}  // namespace patchlab
