// Outlines of planes whose points have any shape: a triangle, a row, parts apart. Every fit is a patch or
// says why not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/fit/fit_patch.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using Polygon = std::vector<Vector2d>;

bool inside(const Polygon& polygon, double x, double y) {
  bool odd = false;
  for (std::size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    const Vector2d &a = polygon[i], &b = polygon[before];
    if ((a.y() > y) != (b.y() > y) && x < a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) odd = !odd;
  }
  return odd;
}

// Points of a plane 1 m away, a grid of pixels 5 mm apart, inside any of the polygons (m).
Observations plane_inside(const std::vector<Polygon>& polygons, Random& random) {
  constexpr double apart = 5e-3, sigma = 1e-3, reach = 0.2;
  Observations observations;
  for (double x = -reach; x <= reach; x += apart)
    for (double y = -reach; y <= reach; y += apart)
      for (const Polygon& polygon : polygons)
        if (inside(polygon, x, y)) {
          observations.points.emplace_back(x, y, 1.0 + 0.3 * x + sigma * random.normal());
          observations.covariances.push_back(sigma * sigma * Matrix3d::Identity());
        }
  return observations;
}

FitOptions plane(BoundaryRequest boundary) {
  FitOptions options;
  options.surface = SurfaceRequest::plane;
  options.boundary = boundary;
  return options;
}

bool has_warning(const FitReport& report, const std::string& name) {
  return std::ranges::count(report.warnings, name, &Finding::name) > 0;
}

TEST(PlaneOutline, TriangleHasNoFourEdges) {
  test::SeededRandom random;
  const Observations observations = plane_inside({{{-0.15, -0.1}, {0.15, -0.1}, {0.0, 0.15}}}, random);
  const Result<FitResult> fit = fit_patch(observations, plane(BoundaryRequest::convex_quad));
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_TRUE(validate(fit->patch)) << fit->patch.parameters.transpose();
  EXPECT_TRUE(has_warning(fit->report, "no_four_edges"));
}

TEST(PlaneOutline, QuadHasFour) {
  test::SeededRandom random;
  const Observations observations =
      plane_inside({{{-0.15, -0.1}, {0.15, -0.12}, {0.12, 0.11}, {-0.13, 0.15}}}, random);
  const Result<FitResult> fit = fit_patch(observations, plane(BoundaryRequest::convex_quad));
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_TRUE(validate(fit->patch)) << fit->patch.parameters.transpose();
  EXPECT_FALSE(has_warning(fit->report, "no_four_edges"));
}

// As a hand draws them: stars that cross themselves, of one part or two.
TEST(PlaneOutline, WhateverTheShapeTheFitIsAPatchOrSaysWhyNot) {
  test::SeededRandom random;
  const auto star = [&] {
    const Vector2d centre(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    Polygon polygon;
    const int corners = 3 + static_cast<int>(random.uniform(0.0, 4.99));
    for (int i = 0; i < corners; ++i) {
      const double turn = random.uniform(0.0, 2.0 * std::numbers::pi), r = random.uniform(0.01, 0.12);
      polygon.push_back(centre + r * Vector2d(std::cos(turn), std::sin(turn)));
    }
    return polygon;
  };
  int patches = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Observations observations = plane_inside(
        trial % 3 == 0 ? std::vector<Polygon>{star(), star()} : std::vector<Polygon>{star()}, random);
    for (const BoundaryRequest boundary : {BoundaryRequest::convex_quad, BoundaryRequest::automatic}) {
      const Result<FitResult> fit = fit_patch(observations, plane(boundary));
      EXPECT_TRUE(fit || fit.error().message.find("no patch") == std::string::npos) << fit.error().message;
      if (!fit) continue;
      EXPECT_TRUE(validate(fit->patch)) << trial << ": " << fit->patch.parameters.transpose();
      ++patches;
    }
  }
  EXPECT_GT(patches, 80);
}

}  // namespace
}  // namespace patchlab
