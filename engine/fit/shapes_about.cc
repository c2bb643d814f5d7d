#include "engine/fit/shapes_about.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/fit/edge_lines.h"
#include "engine/patch/hull.h"

namespace patchlab {
namespace {

double turn_between(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

// A convex polygon as lines, for dropping edges.
struct Line {
  double phi, rho;
};
Vector2d meet(const Line& a, const Line& b) {
  Edges<double> edges = Edges<double>::Zero();
  edges.head<4>() << a.phi, a.rho, b.phi, b.rho;
  return corner<double>(edges, 0, 1);
}

// Area gained when line i is dropped and its neighbours are extended to meet; infinite when they do not.
double cost_of_dropping(const std::vector<Line>& lines, std::size_t i) {
  const std::size_t n = lines.size();
  const Line &before = lines[(i + n - 1) % n], &after = lines[(i + 1) % n];
  const double turn = turn_between(after.phi - before.phi);
  if (turn <= 1e-6 || turn >= std::numbers::pi - 1e-3) return std::numeric_limits<double>::infinity();
  const Vector2d tip = meet(before, after), p = meet(before, lines[i]), q = meet(lines[i], after);
  return 0.5 * std::abs((p - tip).x() * (q - tip).y() - (p - tip).y() * (q - tip).x());
}

}  // namespace

EdgeVector quad_about(const std::vector<Vector2d>& hull) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d along = hull[(i + 1) % hull.size()] - hull[i];
    const double phi = std::atan2(-along.x(), along.y());
    lines.push_back({phi, Vector2d(std::cos(phi), std::sin(phi)).dot(hull[i])});
  }
  while (lines.size() > 4) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double cost = cost_of_dropping(lines, i);
      if (cost < least) {
        least = cost;
        best = i;
      }
    }
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(best));
  }
  EdgeVector edges;
  for (int e = 0; e < 4; ++e) {
    const Line& l = lines[static_cast<std::size_t>(e)];
    edges.segment<2>(2 * e) << l.phi, l.rho;
  }
  return edges;
}

// The rectangle of least area about a hull: one side lies on a hull edge.
EdgeVector rectangle_about(const std::vector<Vector2d>& hull) {
  EdgeVector best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d along = hull[(i + 1) % hull.size()] - hull[i];
    const double phi = std::atan2(-along.x(), along.y());
    EdgeVector edges;
    for (int e = 0; e < 4; ++e) {
      const double angle = phi + e * std::numbers::pi / 2.0;
      const Vector2d n(std::cos(angle), std::sin(angle));
      double reach = -std::numeric_limits<double>::infinity();
      for (const Vector2d& v : hull) reach = std::max(reach, n.dot(v));
      edges.segment<2>(2 * e) << angle, reach;
    }
    const double area = (edges[1] + edges[5]) * (edges[3] + edges[7]);
    if (area < least) {
      least = area;
      best = edges;
    }
  }
  return best;
}

double least_ellipse_area(const std::vector<Vector2d>& hull) {
  return std::numbers::pi * smallest_ellipse(hull, 1e-3).d.prod();
}

double least_circle_area(const std::vector<Vector2d>& hull) {
  Vector2d centre = Vector2d::Zero();
  double radius = 0.0;
  const auto holds = [&](const Vector2d& p) { return (p - centre).norm() <= radius * (1.0 + 1e-12); };
  const auto by_diameter = [&](const Vector2d& a, const Vector2d& b) {
    centre = 0.5 * (a + b);
    radius = 0.5 * (a - b).norm();
  };
  const auto through = [&](const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    Matrix2d chords;
    chords << (b - a).transpose(), (c - a).transpose();
    if (std::abs(chords.determinant()) < 1e-300) return;
    centre = a + chords.inverse() * Vector2d(0.5 * (b - a).squaredNorm(), 0.5 * (c - a).squaredNorm());
    radius = (a - centre).norm();
  };
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (holds(hull[i])) continue;
    centre = hull[i];
    radius = 0.0;
    for (std::size_t j = 0; j < i; ++j) {
      if (holds(hull[j])) continue;
      by_diameter(hull[i], hull[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!holds(hull[k])) through(hull[i], hull[j], hull[k]);
      }
    }
  }
  return std::numbers::pi * radius * radius;
}

}  // namespace patchlab
