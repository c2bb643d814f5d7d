#include "engine/map/shapes_around.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlab {
namespace {

constexpr double beyond_all = std::numeric_limits<double>::infinity();

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Half extents and middle of the points along axes turned by `angle`.
TurnedShape box_at(const std::vector<Vector2d>& points, double angle) {
  const Vector2d x(std::cos(angle), std::sin(angle)), y(-x.y(), x.x());
  Vector2d low(beyond_all, beyond_all), high(-beyond_all, -beyond_all);
  for (const Vector2d& p : points) {
    const Vector2d q(x.dot(p), y.dot(p));
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  const Vector2d middle = 0.5 * (low + high);
  return {middle.x() * x + middle.y() * y, angle, 0.5 * (high - low)};
}

double area_of(const std::array<Vector2d, 4>& v) { return 0.5 * cross(v[2] - v[0], v[3] - v[1]); }

// Where the lines along two sides of the hull meet, going counterclockwise from one to the other.
std::optional<Vector2d> meeting(const std::vector<Vector2d>& hull, std::size_t i, std::size_t j) {
  const Vector2d a = hull[i], b = hull[j];
  const Vector2d u = hull[(i + 1) % hull.size()] - a, v = hull[(j + 1) % hull.size()] - b;
  const double turn = cross(u, v);
  if (turn <= 1e-9 * u.norm() * v.norm()) return std::nullopt;  // half a turn or more: they never close
  return a + u * (cross(b - a, v) / turn);
}

}  // namespace

Vector3d ball_centre(const std::vector<Vector3d>& points) {
  Vector3d centre = points.front();
  for (int i = 1; i <= 2000; ++i) {
    const auto farthest =
        std::ranges::max_element(points, {}, [&](const Vector3d& p) { return (p - centre).squaredNorm(); });
    centre += (*farthest - centre) / (i + 1.0);
  }
  return centre;
}

TurnedShape smallest_rectangle(const std::vector<Vector2d>& hull) {
  TurnedShape best = box_at(hull, 0.0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d side = hull[(i + 1) % hull.size()] - hull[i];
    const TurnedShape box = box_at(hull, std::atan2(side.y(), side.x()));
    if (box.d.prod() < best.d.prod()) best = box;
  }
  return best;
}

Vector2d smallest_centred_ellipse(const std::vector<Vector2d>& points) {
  // d_x = s a, d_y = a / s: the least area a^2 by the ratio s^2, convex in log s.
  const auto size = [&](double log_s) {
    double largest = 0.0;
    for (const Vector2d& p : points) {
      largest = std::max(largest, std::hypot(p.x() * std::exp(-log_s), p.y() * std::exp(log_s)));
    }
    return largest;
  };
  double low = -4.0, high = 4.0;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (size(a) < size(b) ? high : low) = size(a) < size(b) ? b : a;
  }
  const double log_s = 0.5 * (low + high), a = size(log_s);
  return {a * std::exp(log_s), a * std::exp(-log_s)};
}

std::optional<std::array<Vector2d, 4>> smallest_quad(const std::vector<Vector2d>& hull) {
  std::optional<std::array<Vector2d, 4>> best;
  const std::size_t n = hull.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        for (std::size_t l = k + 1; l < n; ++l) {
          const auto a = meeting(hull, i, j), b = meeting(hull, j, k), c = meeting(hull, k, l),
                     d = meeting(hull, l, i);
          if (!a || !b || !c || !d) continue;
          const std::array<Vector2d, 4> quad = {*a, *b, *c, *d};
          if (!best || area_of(quad) < area_of(*best)) best = quad;
        }
      }
    }
  }
  return best;
}

}  // namespace patchlab
