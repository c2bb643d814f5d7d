#include "engine/region/lasso.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "engine/base/random.h"
#include "engine/region/lasso_candidates.h"
#include "engine/region/polygon_mask.h"

namespace patchlab {
namespace {

using Contour = std::vector<Eigen::Vector2d>;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Contour circle(const Eigen::Vector2d& centre, double radius, int vertices) {
  Contour contour;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / vertices;
    contour.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return contour;
}

Contour random_contour(Random& random, int vertices, double low, double high) {
  Contour contour;
  for (int i = 0; i < vertices; ++i) {
    const double x = random.uniform(low, high), y = random.uniform(low, high);
    contour.emplace_back(x, y);
  }
  return contour;
}

Contour star(int points, int step) {
  const Contour ring = circle({400.0, 300.0}, 280.0, points);
  Contour contour;
  for (int i = 0; i < points; ++i) contour.push_back(ring[static_cast<std::size_t>(i * step % points)]);
  return contour;
}

struct NamedContour {
  const char* name;
  Contour contour;
};

std::vector<NamedContour> nasty_contours() {
  Random random(20110925);
  std::vector<NamedContour> contours = {
      {"square on pixel corners", {{100, 100}, {500, 100}, {500, 400}, {100, 400}}},
      {"clockwise square", {{100, 400}, {500, 400}, {500, 100}, {100, 100}}},
      {"figure of eight", {{100, 100}, {500, 400}, {500, 100}, {100, 400}}},
      {"pentagram", star(5, 2)},
      {"star that winds many times", star(101, 50)},
      {"the same contour twice", {{100, 100}, {500, 100}, {300, 400}, {100, 100}, {500, 100}, {300, 400}}},
      {"sliver thinner than a pixel", {{10.0, 10.0}, {700.0, 310.1}, {10.0, 10.2}}},
      {"spikes there and back",
       {{100, 100}, {600, 100}, {600, 300}, {350, 300}, {350, 550}, {350, 300}, {100, 300}}},
      {"steps of one pixel", {}},
      {"repeated vertices",
       {{100, 100}, {100, 100}, {500, 120}, {500, 120}, {500, 120}, {200, 500}, {100, 100}}},
      {"on one line", {{100, 100}, {300, 200}, {500, 300}}},
      {"one place", {{250.5, 250.5}, {250.5, 250.5}, {250.5, 250.5}}},
      {"smaller than a pixel", {{250.1, 250.2}, {250.7, 250.3}, {250.4, 250.9}}},
      {"outside the viewport too", {{-900, -700}, {2500, 100}, {300, 3000}}},
      {"nearly level edges", {{10, 200}, {700, 200.0000000001}, {700, 350}, {10, 350.0000000001}}},
      {"fine circle", circle({400, 300}, 250, 1000)},
      {"tangle", random_contour(random, 60, 0.0, 800.0)},
      {"tangle of many", random_contour(random, 400, 0.0, 800.0)},
      {"tangle on whole pixels", {}},
      {"too far out for a grid", {{-1e12, -1e12}, {1e12, 0.0}, {0.0, 1e12}}},
      {"not finite", {{100, 100}, {kInfinity, 100}, {300, kNaN}}},
  };
  for (NamedContour& named : contours) {
    if (named.name == std::string("steps of one pixel")) {
      for (int i = 0; i < 300; ++i) {
        named.contour.emplace_back(100 + i, 100 + i);
        named.contour.emplace_back(101 + i, 100 + i);
      }
      named.contour.emplace_back(100, 400);
    }
    if (named.name == std::string("tangle on whole pixels")) {
      for (int i = 0; i < 80; ++i) {
        named.contour.emplace_back(static_cast<double>(random.index(40)) * 20.0,
                                   static_cast<double>(random.index(40)) * 20.0);
      }
    }
  }
  return contours;
}

// Points everywhere, on the vertices, on the edges, on cell borders, a bit beside each.
std::vector<Eigen::Vector2d> awkward_points(const Contour& contour, Random& random) {
  std::vector<Eigen::Vector2d> points = {
      {kNaN, 3.0}, {3.0, kNaN}, {kInfinity, 3.0}, {3.0, -kInfinity}, {0.0, 0.0}};
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Eigen::Vector2d& a = contour[i];
    const Eigen::Vector2d& b = contour[(i + 1) % contour.size()];
    const Eigen::Vector2d on_edge = a + random.uniform() * (b - a);
    for (const Eigen::Vector2d& p : {a, on_edge, Eigen::Vector2d(0.5 * (a + b))}) {
      points.push_back(p);
      points.push_back(p.array().round());
      points.emplace_back(std::nextafter(p.x(), kInfinity), p.y());
      points.emplace_back(p.x(), std::nextafter(p.y(), -kInfinity));
      points.emplace_back(random.uniform(0.0, 800.0), p.y());
      points.emplace_back(p.x(), random.uniform(0.0, 800.0));
    }
  }
  return points;
}

TEST(PolygonMask, EqualsTheExactTestAtAMillionPoints) {
  Random random(7);
  const Contour contour = random_contour(random, 30, 100.0, 1180.0);
  const std::vector<PolygonEdge> edges = polygon_edges(contour);
  const PolygonMask mask(contour);
  std::size_t inside = 0, different = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const double x = random.uniform(0.0, 1280.0), y = random.uniform(0.0, 1280.0);
    const bool exact = inside_polygon(edges, x, y);
    inside += exact;
    different += exact != mask.contains(x, y);
  }
  EXPECT_EQ(different, 0u);
  EXPECT_GT(inside, 100'000u);
}

TEST(PolygonMask, EqualsTheExactTestForNastyContoursOnTheirEdgesAndVertices) {
  Random random(11);
  for (const auto& [name, contour] : nasty_contours()) {
    const std::vector<PolygonEdge> edges = polygon_edges(contour);
    const PolygonMask mask(contour);
    std::vector<Eigen::Vector2d> points = awkward_points(contour, random);
    for (int i = 0; i < 2'000; ++i) {
      const double x = random.uniform(-50.0, 850.0), y = random.uniform(-50.0, 850.0);
      points.emplace_back(x, y);
    }
    std::size_t different = 0;
    for (const Eigen::Vector2d& p : points) {
      different += inside_polygon(edges, p.x(), p.y()) != mask.contains(p.x(), p.y());
    }
    EXPECT_EQ(different, 0u) << name;
  }
}

TEST(InsidePolygon, FollowsTheEvenOddRule) {
  const Contour pentagram = star(5, 2);
  EXPECT_FALSE(inside_polygon(pentagram, 400.0, 300.0)) << "the middle is encircled twice";
  EXPECT_TRUE(inside_polygon(pentagram, 640.0, 300.0)) << "a tip is encircled once";
  EXPECT_FALSE(inside_polygon(pentagram, 100.0, 50.0));
}

TEST(InsidePolygon, GivesAPointOnASharedEdgeToExactlyOneOfTwoNeighbours) {
  const Contour left = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Contour right = {{10, 0}, {20, 0}, {20, 10}, {10, 10}};
  for (const double y : {0.0, 2.5, 9.0})
    EXPECT_NE(inside_polygon(left, 10, y), inside_polygon(right, 10, y)) << y;
}

TEST(Project, PutsTheViewDirectionInTheMiddleOfTheViewport) {
  const ViewCamera camera;
  const Projected middle = project(camera, {0, 0, -2});
  EXPECT_DOUBLE_EQ(middle.x, 640.0);
  EXPECT_DOUBLE_EQ(middle.y, 400.0);
  EXPECT_DOUBLE_EQ(middle.depth, 2.0);
}

TEST(Project, PutsTheUpperEdgeOfTheFieldOfViewOnRowZero) {
  const ViewCamera camera;
  const Projected top = project(camera, {0.1, 2.0 * std::tan(0.4), -2.0});
  EXPECT_NEAR(top.y, 0.0, 1e-9);
  EXPECT_GT(top.x, 640.0);
}

TEST(Project, TurnsAndMovesWithTheCamera) {
  ViewCamera camera;
  const Eigen::Quaterniond world_from_view(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()));
  camera.position = {4e5, -5e6, 120.0};
  camera.quaternion_xyzw = {world_from_view.x(), world_from_view.y(), world_from_view.z(),
                            world_from_view.w()};
  const Eigen::Vector3d q_view(0.3, -0.2, -1.7);
  const Projected moved = project(camera, world_from_view * q_view + camera.position);
  const Projected still = project(ViewCamera{}, q_view);
  EXPECT_NEAR(moved.x, still.x, 1e-5);
  EXPECT_NEAR(moved.y, still.y, 1e-5);
  EXPECT_NEAR(moved.depth, still.depth, 1e-8);
}

TEST(Project, KeepsSizesWhereTheViewIsOrthographic) {
  ViewCamera camera;
  camera.perspective = false;
  camera.height = 4.0;
  for (const double depth : {1.0, 9.0}) {
    const Projected corner = project(camera, {1.0, 2.0, -depth});
    EXPECT_DOUBLE_EQ(corner.x, 640.0 + 200.0);
    EXPECT_DOUBLE_EQ(corner.y, 0.0);
  }
}

Scan scan_of(const std::vector<Eigen::Vector3f>& positions) {
  Scan scan;
  scan.positions = positions;
  for (const Eigen::Vector3f& p : positions) scan.finite.push_back(p.allFinite());
  scan.finite_count = static_cast<std::size_t>(std::count(scan.finite.begin(), scan.finite.end(), 1));
  scan.width = static_cast<std::uint32_t>(positions.size());
  return scan;
}

const Contour kMiddle = {{540, 300}, {740, 300}, {740, 500}, {540, 500}};

TEST(SelectLasso, TakesFinitePointsInFrontOfTheNearPlaneInsideTheContour) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Scan scan =
      scan_of({{0, 0, -1}, {0, 0, 1}, {nan, 0, -1}, {5, 0, -1}, {0, 0, -0.005F}, {0, 0, 0}, {0.01F, 0, -3}});
  EXPECT_THAT(select_lasso(scan, ViewCamera{}, kMiddle), ElementsAre(0u, 6u));
}

TEST(SelectLasso, SelectsNothingWithFewerThanThreeVertices) {
  const Scan scan = scan_of({{0, 0, -1}});
  EXPECT_THAT(select_lasso(scan, ViewCamera{}, {}), IsEmpty());
  EXPECT_THAT(select_lasso(scan, ViewCamera{}, {{540, 300}, {740, 500}}), IsEmpty());
}

TEST(SelectLasso, SeesPointsWhereTheOriginOfTheScanPutsThem) {
  Scan scan = scan_of({{0, 0, 0}, {0.25F, 0, 0}});
  scan.origin = {512345.25, 5403210.5, 301.0};
  ViewCamera camera;
  camera.position = scan.origin + Eigen::Vector3d(0, 0, 1);
  EXPECT_THAT(select_lasso(scan, camera, {{630, 390}, {650, 390}, {650, 410}, {630, 410}}), ElementsAre(0u));
}

TEST(SelectLasso, EqualsTheExactTestOfEveryProjectedPoint) {
  Random random(3);
  std::vector<Eigen::Vector3f> positions;
  for (int i = 0; i < 30'000; ++i) positions.push_back(random.normal3().cast<float>());
  const Scan scan = scan_of(positions);
  ViewCamera camera;
  camera.position = {0.2, -0.1, 2.5};
  const Contour contour = random_contour(random, 40, 200.0, 900.0);
  for (const bool perspective : {true, false}) {
    camera.perspective = perspective;
    camera.height = 3.0;
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Projected pixel = project(camera, scan.point(i));
      const bool in = pixel.depth > camera.near_plane && inside_polygon(contour, pixel.x, pixel.y);
      if (in) expected.push_back(static_cast<std::uint32_t>(i));
    }
    EXPECT_GT(expected.size(), 3'000u);
    EXPECT_EQ(select_lasso(scan, camera, contour), expected);
  }
}

TEST(SelectLasso, TakesNothingBeyondTheFarPlane) {
  const Scan scan = scan_of({{0, 0, -1}, {0, 0, -2}, {0, 0, -2.001F}, {0, 0, -1e30F}});
  ViewCamera camera;
  camera.far_plane = 2.0;
  EXPECT_THAT(select_lasso(scan, camera, kMiddle), ElementsAre(0u, 1u));
  camera.far_plane = 0.5;
  EXPECT_THAT(select_lasso(scan, camera, kMiddle), IsEmpty());
}

std::vector<std::uint32_t> tested_one_by_one(const Scan& scan, const ViewCamera& camera,
                                             const Contour& contour) {
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    const Projected pixel = project(camera, scan.point(i));
    const bool in =
        scan.finite[i] && in_depth(camera, pixel.depth) && inside_polygon(contour, pixel.x, pixel.y);
    if (in) inside.push_back(i);
  }
  return inside;
}

// From afar and from within, about far origins, with points that are not numbers or out of all bounds.
TEST(SelectLasso, EqualsTheExactTestFromAnyCamera) {
  Random random(5);
  std::vector<Eigen::Vector3f> positions = {
      {1e30F, 1, -1}, {-3e38F, 3e38F, -3e38F}, {0, 0, -1e30F}, {kNaN, 0, 0}, {0, 0, kNaN}, {1e-30F, 0, -1}};
  for (int i = 0; i < 20'000; ++i) positions.push_back(random.normal3().cast<float>());
  Scan scan = scan_of(positions);
  for (const double far : {0.0, 5e6}) {
    for (const double distance : {0.0, 0.02, 2.5, 4e3}) {
      for (const bool perspective : {true, false}) {
        scan.origin = Eigen::Vector3d(far, -far, far);
        ViewCamera camera;
        camera.position = scan.origin + Eigen::Vector3d(0.1, 0.2, distance);
        camera.perspective = perspective;
        if (distance == 2.5) camera.far_plane = 3.0;
        camera.fov_y = distance > 1e3 ? 1e-3 : 0.8;
        camera.height = distance > 1e3 ? 0.01 : 3.0;
        const Contour contour = random_contour(random, 40, -200.0, 1500.0);
        EXPECT_EQ(select_lasso(scan, camera, contour), tested_one_by_one(scan, camera, contour))
            << far << " " << distance << " " << perspective;
      }
    }
  }
}

using Candidates = void (*)(const CellCamera&, const PolygonMask::Grid&, const float*, std::size_t,
                            LassoCandidates&);

std::vector<std::uint32_t> numbers_of(const LassoCandidates::Bits& bits) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < LassoCandidates::capacity; ++i) {
    if ((bits[i / 64] >> i % 64 & 1U) != 0) numbers.push_back(i);
  }
  return numbers;
}

TEST(LassoCandidates, AreExactWhereTheyAreNotLeftOpenAndFewAre) {
  Random random(6);
  const Contour contour = circle({640, 400}, 250, 200);
  const PolygonMask mask(contour);
  for (const bool perspective : {true, false}) {
    ViewCamera view;
    view.perspective = perspective;
    view.height = 5.0;
    view.far_plane = 6.5;
    const CellCamera camera = cell_camera(view, Eigen::Vector3d::Zero(), mask.grid());
    for (const Candidates candidates : {find_candidates, find_candidates_plain}) {
      for (const double spread : {1.0, 0.1}) {  // most out of the lasso; most in it
        std::size_t found_inside = 0, found_open = 0;
        for (std::uint32_t less = 0; less < 50; ++less) {
          std::vector<Eigen::Vector3f> points(LassoCandidates::capacity - less);
          for (Eigen::Vector3f& q : points)
            q = (spread * random.normal3()).cast<float>() - Eigen::Vector3f(0, 0, 5);
          const Scan scan = scan_of(points);
          const std::vector<std::uint32_t> exact = tested_one_by_one(scan, view, contour);
          LassoCandidates found;
          candidates(camera, mask.grid(), points.front().data(), points.size(), found);
          const std::vector<std::uint32_t> all = numbers_of(found.points), open = numbers_of(found.open);
          EXPECT_TRUE(std::ranges::includes(all, open));
          EXPECT_TRUE(std::ranges::includes(all, exact));
          EXPECT_TRUE(std::ranges::includes(exact, combine(all, open, SelectMode::subtract)));
          found_inside += exact.size();
          found_open += open.size();
        }
        EXPECT_GT(found_inside, 1'000u);
        EXPECT_LT(found_open, found_inside / 10);
      }
    }
  }
}

TEST(LassoCandidates, HaveTheirNumbersWrittenInOrderAndNothingBesides) {
  Random random(9);
  for (const double share : {0.0, 0.01, 0.3, 0.99, 1.0}) {
    for (std::size_t words = 0; words < 40; ++words) {
      std::vector<std::uint64_t> bits(words);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < 64 * words; ++i) {
        if (random.uniform() >= share) continue;
        bits[i / 64] |= std::uint64_t{1} << i % 64;
        expected.push_back(1000 + i);
      }
      EXPECT_EQ(count_bits(bits), expected.size());
      for (const auto write : {write_numbers, write_numbers_plain}) {
        std::vector<std::uint32_t> numbers(expected.size() + 1, 7);
        write(bits, 1000, std::span(numbers).first(expected.size()));
        EXPECT_EQ(numbers.back(), 7u);
        numbers.pop_back();
        EXPECT_EQ(numbers, expected);
      }
    }
  }
}

// Neither the distance of the camera nor that of the lasso from the middle of the view leaves much open.
TEST(CellCamera, IsSureOfMostDepths) {
  const PolygonMask mask(circle({1200, 90}, 250, 200));
  for (const double distance : {0.0, 10.0, 100.0}) {
    ViewCamera view;
    view.position = {0.0, distance, 0.0};
    const CellCamera near = cell_camera(view, Eigen::Vector3d::Zero(), mask.grid());
    EXPECT_LT(near.sure_from, 0.02 + 0.1 * distance);
    EXPECT_GT(near.sure_to, 1e6F);
    view.perspective = false;
    view.height = 2.0 + distance;
    const CellCamera flat = cell_camera(view, Eigen::Vector3d::Zero(), mask.grid());
    EXPECT_LT(flat.sure_from, 0.02 + 0.01 * distance);
    EXPECT_GT(flat.sure_to, 20.0F);
  }
}

TEST(Combine, IsTheAlgebraOfSets) {
  const std::vector<std::uint32_t> before = {1, 2, 5, 9}, selected = {2, 3, 9, 12};
  EXPECT_THAT(combine(before, selected, SelectMode::set), ElementsAre(2, 3, 9, 12));
  EXPECT_THAT(combine(before, selected, SelectMode::add), ElementsAre(1, 2, 3, 5, 9, 12));
  EXPECT_THAT(combine(before, selected, SelectMode::subtract), ElementsAre(1, 5));
  EXPECT_THAT(combine(before, selected, SelectMode::intersect), ElementsAre(2, 9));
}

}  // namespace
}  // namespace patchlab
