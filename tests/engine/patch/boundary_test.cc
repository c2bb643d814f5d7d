#include "engine/patch/boundary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/numeric_jacobian.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

using std::numbers::pi;

Boundary bound(BoundaryType type, std::initializer_list<double> d) {
  Boundary boundary{type, BoundaryVector(static_cast<Eigen::Index>(d.size()))};
  std::copy(d.begin(), d.end(), boundary.d.begin());
  return boundary;
}

const Boundary ellipse = bound(BoundaryType::ellipse, {0.2, 0.1});
const Boundary circle = bound(BoundaryType::circle, {0.15});
const Boundary rectangle = bound(BoundaryType::rectangle, {0.2, 0.1});
const Boundary quad = bound(BoundaryType::convex_quad, {0.1, 0.2, 0.15, 0.12, 0.6});
const Boundary triangle = bound(BoundaryType::convex_quad, {0.1, 0.2, 0.0, 0.12, 0.6});  // v_3 at the centre

struct NamedBoundary {
  const char* name;
  Boundary boundary;
};
void PrintTo(const NamedBoundary& named, std::ostream* out) { *out << named.name; }
std::string boundary_name(const testing::TestParamInfo<NamedBoundary>& of) { return of.param.name; }

class EveryBoundary : public testing::TestWithParam<NamedBoundary> {
 protected:
  const Boundary& bound_ = GetParam().boundary;
};
INSTANTIATE_TEST_SUITE_P(All, EveryBoundary,
                         testing::Values(NamedBoundary{"Ellipse", ellipse}, NamedBoundary{"Circle", circle},
                                         NamedBoundary{"Rectangle", rectangle}, NamedBoundary{"Quad", quad},
                                         NamedBoundary{"Triangle", triangle}),
                         boundary_name);

double shoelace_area(const std::vector<Vector2d>& curve) {
  double twice = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vector2d &a = curve[i], &b = curve[(i + 1) % curve.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

TEST_P(EveryBoundary, OutlineIsWhereTheFunctionIsZero) {
  for (const Vector2d& u : outline(bound_, 40)) EXPECT_NEAR(boundary_function(u, bound_), 0.0, 1e-15);
}

TEST_P(EveryBoundary, OutlineEnclosesTheAreaCounterclockwise) {
  EXPECT_NEAR(shoelace_area(outline(bound_, 4000)) / area(bound_), 1.0, 1e-6);
}

TEST_P(EveryBoundary, ContainsWhatIsJustInsideTheOutlineAndNothingJustOutside) {
  const std::vector<Vector2d> curve = outline(bound_, 40);
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& u : curve) middle += u / static_cast<double>(curve.size());
  for (const Vector2d& u : curve) {
    EXPECT_TRUE(contains(bound_, middle + 0.999 * (u - middle)));
    EXPECT_FALSE(contains(bound_, middle + 1.001 * (u - middle)));
  }
}

TEST_P(EveryBoundary, OutlineHasAtLeastAsManyPointsAsAskedFor) {
  for (const int count : {3, 7, 64, 129})
    EXPECT_GE(outline(bound_, count).size(), static_cast<std::size_t>(count));
}

TEST_P(EveryBoundary, OutlinePointDerivativesMatchDifferences) {
  for (const double s : {0.0, 0.1, 0.3, 0.62, 0.9}) {
    const auto u_of_d = [&](const VectorXd& d) -> VectorXd { return outline_point({bound_.type, d}, s).u; };
    EXPECT_TRUE(jacobian_matches(outline_point(bound_, s).J_u_d, u_of_d, bound_.d));
  }
}

TEST_P(EveryBoundary, OutwardPointsAcrossTheCurveAndOut) {
  for (const double s : {0.1, 0.3, 0.62, 0.9}) {
    const OutlinePoint at = outline_point(bound_, s);
    const Vector2d along = outline_point(bound_, s + 1e-6).u - outline_point(bound_, s - 1e-6).u;
    EXPECT_NEAR(at.outward.norm(), 1.0, 1e-15);
    EXPECT_NEAR(at.outward.dot(along.normalized()), 0.0, 1e-7);
    EXPECT_GT(boundary_function(at.u + 1e-4 * at.outward, bound_), 0.0);
  }
}

TEST_P(EveryBoundary, OutwardAtACornerLeavesBothEdges) {
  for (const double s : {0.0, 0.25, 0.5, 0.75}) {
    const OutlinePoint at = outline_point(bound_, s);
    EXPECT_NEAR(at.outward.norm(), 1.0, 1e-15);
    EXPECT_GT(boundary_function(at.u + 1e-4 * at.outward, bound_), 0.0);
  }
}

TEST_P(EveryBoundary, ExtentIsTheLargestReachOfTheOutline) {
  Vector2d largest = Vector2d::Zero();
  for (const Vector2d& u : outline(bound_, 400)) largest = largest.cwiseMax(u.cwiseAbs());
  EXPECT_LT((extent(bound_) - largest).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Boundary, OfAnEllipseIsItsEquation) {
  EXPECT_NEAR(boundary_function({0.2 * std::cos(1.0), 0.1 * std::sin(1.0)}, ellipse), 0.0, 1e-15);
  EXPECT_EQ(boundary_function({0.0, 0.0}, ellipse), -1.0);
  EXPECT_NEAR(boundary_function({0.0, 0.2}, ellipse), 3.0, 1e-15);
}

TEST(Boundary, OfARectangleAndAQuadIsADistanceInMetres) {
  EXPECT_NEAR(boundary_function({0.25, 0.0}, rectangle), 0.05, 1e-15);
  EXPECT_NEAR(boundary_function({0.0, 0.0}, rectangle), -0.1, 1e-15);
  const OutlinePoint at = outline_point(quad, 0.1);
  EXPECT_NEAR(boundary_function(at.u + 0.03 * at.outward, quad), 0.03, 1e-15);
}

TEST(Boundary, CornersOfAQuadLieOnDiagonalsThroughTheCentre) {
  const auto v = vertices(quad);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(v[i].norm(), quad.d[static_cast<Eigen::Index>(i)], 1e-15);
  EXPECT_NEAR(v[0].normalized().dot(v[2].normalized()), -1.0, 1e-15);
  EXPECT_NEAR(v[1].normalized().dot(v[3].normalized()), -1.0, 1e-15);
  EXPECT_NEAR(v[0].normalized().dot(v[3].normalized()), std::cos(2.0 * 0.6), 1e-15);  // 2 gamma between them
}

TEST(Boundary, ARectangleIsAQuad) {
  const Boundary same =
      bound(BoundaryType::convex_quad, {std::hypot(0.2, 0.1), std::hypot(0.2, 0.1), std::hypot(0.2, 0.1),
                                        std::hypot(0.2, 0.1), std::atan2(0.1, 0.2)});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((vertices(same)[i] - vertices(rectangle)[i]).norm(), 1e-15);
  EXPECT_NEAR(area(same), area(rectangle), 1e-15);
}

TEST(Boundary, OutlineHoldsTheCorners) {
  const std::vector<Vector2d> curve = outline(quad, 10);
  ASSERT_EQ(curve.size() % 4, 0u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((curve[i * curve.size() / 4] - vertices(quad)[i]).norm(), 1e-15);
}

TEST(Boundary, AQuadWithTwoVerticesAtTheCentreIsATriangle) {
  const Boundary corner = bound(BoundaryType::convex_quad, {0.0, 0.0, 0.15, 0.12, 0.6});
  EXPECT_NEAR(area(corner), 0.5 * 0.15 * 0.12 * std::sin(2.0 * 0.6), 1e-15);
  EXPECT_TRUE(contains(corner, 0.2 * (vertices(corner)[2] + vertices(corner)[3])));
  EXPECT_FALSE(contains(corner, {0.01, 0.05}));
  for (const double s : {0.0, 0.1, 0.25}) EXPECT_NEAR(outline_point(corner, s).outward.norm(), 1.0, 1e-15);
}

TEST(Boundary, AreasAreThoseOfTheTextbook) {
  EXPECT_NEAR(area(ellipse), pi * 0.02, 1e-15);
  EXPECT_NEAR(area(circle), pi * 0.0225, 1e-15);
  EXPECT_NEAR(area(rectangle), 0.08, 1e-15);
}

}  // namespace
}  // namespace patchlab::test
