#include "engine/mesh/ray_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using Eigen::Vector3d;
using Triangle = RayMesh::Triangle;

struct Mesh {
  std::vector<Vector3d> vertices;
  std::vector<Triangle> triangles;
};

Mesh loose_triangles(test::SeededRandom& random, std::uint32_t count) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vector3d middle = 2.0 * random.normal3();
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(middle + 0.4 * random.normal3());
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

// s and the barycentric coordinates from three linear equations.
std::optional<double> hit_by_definition(const Mesh& mesh, const Vector3d& origin, const Vector3d& direction) {
  std::optional<double> nearest;
  for (const auto& [a, b, c] : mesh.triangles) {
    Eigen::Matrix3d equations;
    equations << mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a], -direction;
    const Vector3d solution = equations.fullPivLu().solve(origin - mesh.vertices[a]);
    const bool inside = solution[0] >= 0.0 && solution[1] >= 0.0 && solution[0] + solution[1] <= 1.0;
    if (inside && solution[2] > 0.0) nearest = std::min(nearest.value_or(solution[2]), solution[2]);
  }
  return nearest;
}

TEST(RayMesh, GivesTheNearestTriangleOfAll) {
  test::SeededRandom random;
  const Mesh mesh = loose_triangles(random, 300);
  const RayMesh tree(mesh.vertices, mesh.triangles);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d origin = 4.0 * random.normal3(), direction = random.normal3() - 0.5 * origin;
    const std::optional<double> expected = hit_by_definition(mesh, origin, direction),
                                found = tree.hit(origin, direction);
    ASSERT_EQ(found.has_value(), expected.has_value()) << i;
    if (!expected) continue;
    EXPECT_NEAR(*found, *expected, 1e-10 * std::max(1.0, *expected));
    ++hits;
  }
  EXPECT_GT(hits, 500);
}

TEST(RayMesh, LetsNoRayThroughASharedEdgeOrCorner) {
  Mesh sheet;
  constexpr std::uint32_t side = 9;
  for (std::uint32_t i = 0; i < side * side; ++i)
    sheet.vertices.emplace_back(0.1 * (i % side), 0.1 * std::floor(i / side), 1.0 + 0.013 * ((7 * i) % 5));
  for (std::uint32_t i = 0; i + side < side * side; ++i) {
    if (i % side == side - 1) continue;
    sheet.triangles.push_back({i, i + 1, i + side});
    sheet.triangles.push_back({i + side, i + 1, i + side + 1});
  }
  const RayMesh tree(sheet.vertices, sheet.triangles);
  const Vector3d eye(0.31, 0.47, 0.0);
  for (std::uint32_t row = 1; row + 1 < side; ++row) {
    for (std::uint32_t column = 1; column + 1 < side; ++column) {
      const Vector3d& corner = sheet.vertices[row * side + column];
      EXPECT_TRUE(tree.hit(eye, corner - eye));
      for (const std::uint32_t next :
           {row * side + column + 1, (row + 1) * side + column, (row + 1) * side + column - 1}) {
        for (const double share : {0.1, 0.3, 0.7}) {
          const Vector3d on_edge = corner + share * (sheet.vertices[next] - corner);
          EXPECT_TRUE(tree.hit(eye, on_edge - eye)) << on_edge.transpose();
        }
      }
    }
  }
}

TEST(RayMesh, IsHitFromBothSidesInFrontOnly) {
  const RayMesh tree({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}});
  EXPECT_DOUBLE_EQ(tree.hit({0.2, 0.2, 0}, {0, 0, 1}).value_or(0.0), 1.0);
  EXPECT_DOUBLE_EQ(tree.hit({0.2, 0.2, 3}, {0, 0, -0.5}).value_or(0.0), 4.0);
  EXPECT_FALSE(tree.hit({0.2, 0.2, 0}, {0, 0, -1}));
  EXPECT_FALSE(tree.hit({0.2, 0.2, 0}, {1, 0, 0}));
  EXPECT_FALSE(tree.hit({0.8, 0.8, 0}, {0, 0, 1}));
}

TEST(RayMesh, LeavesOutWhatHasNoAreaOrNoPlace) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const RayMesh tree({{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, nan, 1}}, {{0, 1, 2}, {0, 1, 3}, {1, 1, 1}});
  EXPECT_EQ(tree.size(), 2u);
  EXPECT_FALSE(tree.hit({0.5, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(RayMesh({}, {}).hit({0, 0, 0}, {0, 0, 1}));
}

}  // namespace
}  // namespace patchlab
