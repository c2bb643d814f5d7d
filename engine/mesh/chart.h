// A chart of a bounded patch: the square [-1, 1]^2 onto the inside of its boundary, the edge of the square
// onto the outline, counterclockwise onto counterclockwise. Straight lines of a rectangle or quad stay
// straight; on the sphere and the cylinder the lines are spaced by angle, so that cells stay well shaped up
// to the rim |kappa| d = 1.
#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/patch/patch.h"

namespace patchlab {

class Chart {
 public:
  explicit Chart(const Patch& patch);

  // u in metre, the local xy plane of the patch; s, t in [-1, 1].
  Vector2d operator()(double s, double t) const;

 private:
  Vector2d in_disc(double s, double t) const;
  Vector2d in_quad(double s, double t) const;
  double spaced_by_angle(double fraction) const;

  Boundary boundary_;
  std::array<Vector2d, 4> corners_{};  // of a rectangle or quad
  double half_angle_ = 0.0;            // of the arc of a sphere or cylinder, rad; 0: no spacing by angle
};

}  // namespace patchlab
