#include "engine/mesh/chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlab {
namespace {

bool has_corners(BoundaryType type) {
  return type == BoundaryType::rectangle || type == BoundaryType::convex_quad;
}

double half_angle_of_arc(const Patch& patch) {
  const double kappa = std::abs(k3(patch).y());
  const Vector2d half_extent = extent(boundary(patch));
  switch (patch.type->surface) {
    case SurfaceType::sphere:
    case SurfaceType::circular_cylinder:
      return std::asin(std::min(1.0, kappa * half_extent.y()));
    default:
      return 0.0;
  }
}

}  // namespace

Chart::Chart(const Patch& patch) : boundary_(boundary(patch)), half_angle_(half_angle_of_arc(patch)) {
  if (has_corners(boundary_.type)) corners_ = vertices(boundary_);
}

Vector2d Chart::operator()(double s, double t) const {
  return has_corners(boundary_.type) ? in_quad(s, t) : in_disc(s, t);
}

// The concentric map of Shirley and Chiu (1997): squares about the centre become circles.
Vector2d Chart::in_disc(double s, double t) const {
  constexpr double eighth_turn = 0.25 * std::numbers::pi;
  const bool beside = std::abs(s) >= std::abs(t);
  const double radius = beside ? s : t;  // its sign chooses the half of the disc
  if (radius == 0.0) return Vector2d::Zero();
  const double angle = beside ? eighth_turn * (t / s) : eighth_turn * (2.0 - s / t);
  const Vector2d disc = spaced_by_angle(radius) * Vector2d(std::cos(angle), std::sin(angle));
  const double d_x = boundary_.d[0], d_y = boundary_.type == BoundaryType::circle ? d_x : boundary_.d[1];
  return {d_x * disc.x(), d_y * disc.y()};
}

Vector2d Chart::in_quad(double s, double t) const {
  const double t_spaced = spaced_by_angle(t);
  const double right = 0.5 * (1.0 + s), left = 0.5 * (1.0 - s);
  const double top = 0.5 * (1.0 + t_spaced), bottom = 0.5 * (1.0 - t_spaced);
  return top * (right * corners_[0] + left * corners_[1]) +
         bottom * (left * corners_[2] + right * corners_[3]);
}

double Chart::spaced_by_angle(double fraction) const {
  if (half_angle_ < 1e-6) return fraction;
  return std::sin(fraction * half_angle_) / std::sin(half_angle_);
}

}  // namespace patchlab
