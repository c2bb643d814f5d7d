// An outline that many points are asked of.
#pragma once

#include <array>

#include "engine/patch/boundary.h"

namespace patchlab {

// What contains(bound, u) says, prepared once.
class InsideOutline {
 public:
  explicit InsideOutline(const Boundary& bound);
  bool contains(double x, double y) const {
    if (round_) {
      const double a = x * inverse_.x(), b = y * inverse_.y();
      return a * a + b * b <= 1.0;
    }
    for (const OuterLine& line : lines_) {
      if (line.normal.x() * x + line.normal.y() * y > line.offset) return false;
    }
    return true;
  }
  // Where a line across at y is inside: from > to, or one of them NaN, where nowhere.
  struct Interval {
    double from, to;
  };
  Interval across(double y) const;

 private:
  // Where normal . u > offset, u lies outside.
  struct OuterLine {
    Vector2d normal;
    double offset;
  };

  bool round_;
  Vector2d radii_, inverse_;
  std::array<OuterLine, 4> lines_;
};

// An ellipse or a circle.
bool is_round(const Boundary& bound);

}  // namespace patchlab
