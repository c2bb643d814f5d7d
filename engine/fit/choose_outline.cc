#include "engine/fit/choose_outline.h"

#include <algorithm>
#include <cmath>

#include "engine/fit/edge_lines.h"
#include "engine/fit/shapes_about.h"
#include "engine/patch/hull.h"

namespace patchlab {
namespace {

struct Kind {
  BoundaryType boundary;
  int parameters;  // size, centre, direction
  double (*least_area)(const std::vector<Vector2d>& hull);
};

constexpr Kind kinds[] = {
    {BoundaryType::ellipse, 5, least_ellipse_area},
    {BoundaryType::circle, 3, least_circle_area},
    {BoundaryType::rectangle, 5,
     [](const std::vector<Vector2d>& hull) { return area_of<double>(rectangle_about(hull)).value; }},
    {BoundaryType::convex_quad, 8,
     [](const std::vector<Vector2d>& hull) { return area_of<double>(quad_about(hull)).value; }},
};

}  // namespace

std::vector<OutlineCandidate> choose_outline(const FootPoints& feet) {
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < feet.x.size(); ++i) {
    if (feet.weight[i] > 0.0) points.push_back(feet.x[i].head<2>());
  }
  const auto n = static_cast<double>(points.size());
  const std::vector<Vector2d> hull = convex_hull(std::move(points));
  std::vector<OutlineCandidate> candidates;
  for (const Kind& kind : kinds) {
    if (kind.boundary == BoundaryType::convex_quad && hull.size() < 4) continue;
    const double area = kind.least_area(hull);
    candidates.push_back(
        {kind.boundary, area, 2.0 * n * std::log(area) + 2.0 * kind.parameters * std::log(n), false});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const OutlineCandidate& a, const OutlineCandidate& b) { return a.score < b.score; });
  candidates.front().chosen = true;
  return candidates;
}

}  // namespace patchlab
