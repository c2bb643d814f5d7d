#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/patch/patch.h"

namespace patchlab {
namespace {

using std::numbers::pi;

// Integral over the ellipse with radii d of sqrt(1 + (kappa_x x)^2 + (kappa_y y)^2): the radial integral in
// closed form, the periodic one by the trapezoidal rule, which converges exponentially.
double paraboloid_area(const Vector2d& d, const Vector2d& kappa) {
  constexpr int count = 1024;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double phi = 2.0 * pi * i / count;
    const double rim = std::hypot(1.0, kappa.x() * d.x() * std::cos(phi), kappa.y() * d.y() * std::sin(phi));
    sum += (rim * rim + rim + 1.0) / (3.0 * (rim + 1.0));
  }
  return 2.0 * pi / count * d.x() * d.y() * sum;
}

// Length of the arc of a parabola or a circle with curvature kappa at its apex, over |y| <= d.
double parabola_length(double d, double kappa) {
  const double slope = kappa * d;
  return kappa == 0.0 ? 2.0 * d : d * std::hypot(1.0, slope) + std::asinh(slope) / kappa;
}
double circle_length(double d, double kappa) {
  return kappa == 0.0 ? 2.0 * d : 2.0 * std::asin(std::clamp(kappa * d, -1.0, 1.0)) / kappa;
}

}  // namespace

double surface_area(const Patch& patch) {
  const Boundary bound = boundary(patch);
  const Vector3d k = k3(patch);
  const double d_x = bound.d[0], d_y = bound.d[bound.d.size() > 1 ? 1 : 0];
  switch (patch.type->surface) {
    case SurfaceType::elliptic_paraboloid:
    case SurfaceType::hyperbolic_paraboloid:
    case SurfaceType::circular_paraboloid:
      return paraboloid_area({d_x, d_y}, k.head<2>());
    case SurfaceType::plane:
      return area(bound);
    case SurfaceType::cylindric_paraboloid:
      return 2.0 * d_x * parabola_length(d_y, k.y());
    case SurfaceType::circular_cylinder:
      return 2.0 * d_x * circle_length(d_y, k.y());
    case SurfaceType::sphere: {
      const Vector2d rim(d_x, 0.0);
      const double z = height(rim, k);
      return pi * (rim.squaredNorm() + z * z);  // pi times the squared chord from the apex
    }
  }
  return 0.0;
}

}  // namespace patchlab
