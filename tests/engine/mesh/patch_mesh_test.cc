#include "engine/mesh/patch_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numbers>

#include "tests/support/sample_patches.h"

namespace patchlab {
namespace {

using test::sample_patch;
using test::sample_patches;
using test::SamplePatch;

constexpr int resolutions[] = {1, 2, 3, 8, 32};

Vector3d point(const TriangleMesh& mesh, OpenMesh::VertexHandle vertex) {
  return Vector3d::Map(mesh.point(vertex).data());
}

Vector3d normal(const TriangleMesh& mesh, OpenMesh::VertexHandle vertex) {
  return Vector3d::Map(mesh.normal(vertex).data());
}

std::array<OpenMesh::VertexHandle, 3> corners(const TriangleMesh& mesh, OpenMesh::FaceHandle face) {
  auto corner = mesh.cfv_ccwiter(face);
  const OpenMesh::VertexHandle a = *corner++, b = *corner++, c = *corner;
  return {a, b, c};
}

// Twice the area of a triangle in the plane of the patch, positive counterclockwise.
double signed_area(const std::vector<Vector2d>& u, const std::array<OpenMesh::VertexHandle, 3>& abc) {
  const auto at = [&](int i) { return u[static_cast<std::size_t>(abc[static_cast<std::size_t>(i)].idx())]; };
  const Vector2d ab = at(1) - at(0), ac = at(2) - at(0);
  return ab.x() * ac.y() - ab.y() * ac.x();
}

double mesh_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto face : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, face);
    area += 0.5 * (point(mesh, b) - point(mesh, a)).cross(point(mesh, c) - point(mesh, a)).norm();
  }
  return area;
}

int boundary_loops(const TriangleMesh& mesh) {
  std::vector<bool> seen(mesh.n_halfedges());
  int loops = 0;
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())]) continue;
    ++loops;
    OpenMesh::HalfedgeHandle walk = start;
    do {
      seen[static_cast<std::size_t>(walk.idx())] = true;
      walk = mesh.next_halfedge_handle(walk);
    } while (walk != start);
  }
  return loops;
}

class PatchMesh : public testing::TestWithParam<SamplePatch> {
 protected:
  const Patch& patch() const { return GetParam().patch; }
};

TEST_P(PatchMesh, IsOneDiscWithOneBoundaryLoop) {
  for (const int resolution : resolutions) {
    const TriangleMesh mesh = surface_mesh(patch(), resolution);
    const auto vertices = static_cast<long>(mesh.n_vertices()), edges = static_cast<long>(mesh.n_edges()),
               faces = static_cast<long>(mesh.n_faces());
    EXPECT_EQ(vertices - edges + faces, 1) << "resolution " << resolution;
    EXPECT_EQ(boundary_loops(mesh), 1) << "resolution " << resolution;
    for (const auto vertex : mesh.vertices()) EXPECT_FALSE(mesh.is_isolated(vertex));
  }
}

TEST_P(PatchMesh, HasBoundaryVerticesOnTheOutlineAndTheOthersInside) {
  for (const int resolution : resolutions) {
    const TriangleMesh mesh = surface_mesh(patch(), resolution);
    const std::vector<Vector2d> u = surface_coordinates(patch(), resolution);
    ASSERT_EQ(u.size(), mesh.n_vertices());
    for (const auto vertex : mesh.vertices()) {
      const double edge = boundary_function(u[static_cast<std::size_t>(vertex.idx())], boundary(patch()));
      if (mesh.is_boundary(vertex)) {
        EXPECT_NEAR(edge, 0.0, 1e-12);
      } else {
        EXPECT_LT(edge, 0.0);
      }
    }
  }
}

TEST_P(PatchMesh, HasNoFlippedOrEmptyTriangle) {
  for (const int resolution : resolutions) {
    const TriangleMesh mesh = surface_mesh(patch(), resolution);
    const std::vector<Vector2d> u = surface_coordinates(patch(), resolution);
    for (const auto face : mesh.faces()) EXPECT_GT(signed_area(u, corners(mesh, face)), 0.0);
  }
}

// Evenly spaced chords cover sin(step) / step of an ellipse.
TEST_P(PatchMesh, CoversTheInsideOfTheBoundaryWithoutGapOrOverlap) {
  const BoundaryType type = patch().type->boundary;
  const bool curved = type == BoundaryType::ellipse || type == BoundaryType::circle;
  for (const int resolution : resolutions) {
    const TriangleMesh mesh = surface_mesh(patch(), resolution);
    const std::vector<Vector2d> u = surface_coordinates(patch(), resolution);
    double covered = 0.0;
    for (const auto face : mesh.faces()) covered += 0.5 * signed_area(u, corners(mesh, face));
    const double step = 2.0 * std::numbers::pi / (4 * resolution);
    const double share = curved ? std::sin(step) / step : 1.0;
    EXPECT_NEAR(covered / area(boundary(patch())), share, 1e-12);
  }
}

TEST_P(PatchMesh, HasVerticesOnTheSurfaceWithItsOutwardNormal) {
  const TriangleMesh mesh = surface_mesh(patch(), 16);
  const std::vector<Vector2d> u = surface_coordinates(patch(), 16);
  for (const auto vertex : mesh.vertices()) {
    const Vector3d q_patch = apply_inverse(world_from_patch(patch()), point(mesh, vertex));
    EXPECT_NEAR((q_patch.head<2>() - u[static_cast<std::size_t>(vertex.idx())]).norm(), 0.0, 1e-14);
    EXPECT_NEAR(implicit(q_patch, k3(patch())), 0.0, 1e-14);
    const Vector3d expected =
        axes(patch()) *
        outward_normal(surface_point(u[static_cast<std::size_t>(vertex.idx())], k3(patch())), k3(patch()));
    EXPECT_NEAR((normal(mesh, vertex) - expected).norm(), 0.0, 1e-14);
    EXPECT_NEAR(normal(mesh, vertex).norm(), 1.0, 1e-14);
  }
}

TEST_P(PatchMesh, TurnsItsTrianglesOutward) {
  const TriangleMesh mesh = surface_mesh(patch(), 16);
  for (const auto face : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, face);
    const Vector3d across = (point(mesh, b) - point(mesh, a)).cross(point(mesh, c) - point(mesh, a));
    for (const auto vertex : {a, b, c}) EXPECT_GT(across.dot(normal(mesh, vertex)), 0.0);
  }
}

TEST_P(PatchMesh, HasTheAreaOfTheSurfaceWhenFine) {
  const double expected = surface_area(patch());
  const double coarse = mesh_area(surface_mesh(patch(), 32)), fine = mesh_area(surface_mesh(patch(), 128));
  EXPECT_NEAR(coarse / expected, 1.0, 4e-3);
  EXPECT_NEAR(fine / expected, 1.0, 3e-4);
}

TEST_P(PatchMesh, OutlineCurveIsTheOutlineOnTheSurface) {
  const std::vector<Vector3d> curve = outline_curve(patch(), 64);
  ASSERT_GE(curve.size(), 64u);
  double turned = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vector3d here = apply_inverse(world_from_patch(patch()), curve[i]);
    const Vector3d next = apply_inverse(world_from_patch(patch()), curve[(i + 1) % curve.size()]);
    EXPECT_NEAR(boundary_function(here.head<2>(), boundary(patch())), 0.0, 1e-12);
    EXPECT_NEAR(implicit(here, k3(patch())), 0.0, 1e-14);
    turned += here.x() * next.y() - here.y() * next.x();
  }
  EXPECT_GT(turned, 0.0);
}

TEST_P(PatchMesh, OffsetCurveLiesBesideTheOutlineOnTheSurface) {
  const std::vector<Vector3d> curve = outline_curve(patch(), 64);
  const double offset = 0.004;
  const std::vector<Vector3d> outer = offset_curve(patch(), std::vector<double>(curve.size(), offset));
  const std::vector<Vector3d> inner = offset_curve(patch(), std::vector<double>(curve.size(), -offset));
  ASSERT_EQ(outer.size(), curve.size());
  const Pose pose = world_from_patch(patch());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vector3d here = apply_inverse(pose, curve[i]), out = apply_inverse(pose, outer[i]),
                   in = apply_inverse(pose, inner[i]);
    EXPECT_NEAR((in - here).head<2>().norm(), offset, 1e-14);
    EXPECT_LE((out - here).head<2>().norm(), offset + 1e-14);
    for (const Vector3d& q : {out, in}) {
      EXPECT_NEAR(implicit(q, k3(patch())), 0.0, 1e-13);
      EXPECT_TRUE(on_modelled_sheet(q, k3(patch())));
    }
    EXPECT_LT(boundary_function(in.head<2>(), boundary(patch())),
              boundary_function(out.head<2>(), boundary(patch())));
  }
}

TEST(OffsetCurve, MovesACircleToTheCircleBeside) {
  const Patch disc = sample_patch("", SurfaceType::plane, BoundaryType::circle, {0.08}, {}).patch;
  for (const Vector3d& q : offset_curve(disc, std::vector<double>(48, 0.01))) {
    EXPECT_NEAR((q - centre(disc)).norm(), 0.09, 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(TableI, PatchMesh, testing::ValuesIn(sample_patches()),
                         [](const auto& sample) { return sample.param.label; });

TEST(SurfaceMesh, HasTheCornersOfAQuad) {
  const Patch quad =
      sample_patch("", SurfaceType::plane, BoundaryType::convex_quad, {0.10, 0.14, 0.07, 0.12, 0.5}, {})
          .patch;
  const std::vector<Vector2d> u = surface_coordinates(quad, 5);
  for (const Vector2d& corner : vertices(boundary(quad))) {
    double nearest = 1.0;
    for (const Vector2d& vertex : u) nearest = std::min(nearest, (vertex - corner).norm());
    EXPECT_LT(nearest, 1e-15);
  }
}

TEST(SurfaceMesh, KeepsTheTrianglesOfADiscWellShaped) {
  const Patch disc = sample_patch("", SurfaceType::plane, BoundaryType::circle, {0.08}, {}).patch;
  const TriangleMesh mesh = surface_mesh(disc, 32);
  double narrowest = std::numbers::pi;
  for (const auto halfedge : mesh.halfedges()) {
    if (!mesh.is_boundary(halfedge)) narrowest = std::min(narrowest, mesh.calc_sector_angle(halfedge));
  }
  EXPECT_GT(narrowest, 30.0 * std::numbers::pi / 180.0);
}

}  // namespace
}  // namespace patchlab
