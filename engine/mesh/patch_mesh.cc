#include "engine/mesh/patch_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/mesh/chart.h"

namespace patchlab {
namespace {

struct PlaneMesh {
  std::vector<Vector2d> vertices;             // u, m
  std::vector<std::array<int, 3>> triangles;  // counterclockwise
};

// A structured grid of (resolution + 1)^2 nodes on the chart. Nodes that coincide (a quad with d_1 = d_2 = 0
// has a side of no length) share one vertex.
class Grid {
 public:
  Grid(const Patch& patch, int resolution)
      : n_(std::max(resolution, 1)), ids_(static_cast<std::size_t>((n_ + 1) * (n_ + 1))) {
    const Chart chart(patch);
    const double tolerance = 1e-12 * extent(boundary(patch)).norm();
    for (int j = 0; j <= n_; ++j) {
      for (int i = 0; i <= n_; ++i) add_node(i, j, chart(coordinate(i), coordinate(j)), tolerance);
    }
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) add_cell(i, j);
    }
  }

  PlaneMesh mesh() && { return std::move(mesh_); }

 private:
  double coordinate(int i) const { return static_cast<double>(2 * i - n_) / n_; }
  int& id(int i, int j) { return ids_[static_cast<std::size_t>(j * (n_ + 1) + i)]; }
  const Vector2d& u(int vertex) const { return mesh_.vertices[static_cast<std::size_t>(vertex)]; }

  void add_node(int i, int j, const Vector2d& node, double tolerance) {
    if (i > 0 && (u(id(i - 1, j)) - node).norm() <= tolerance) {
      id(i, j) = id(i - 1, j);
    } else if (j > 0 && (u(id(i, j - 1)) - node).norm() <= tolerance) {
      id(i, j) = id(i, j - 1);
    } else {
      id(i, j) = static_cast<int>(mesh_.vertices.size());
      mesh_.vertices.push_back(node);
    }
  }

  // The diagonal of a cell starts at its corner nearest to a corner of the grid: there two sides of the cell
  // may lie on one line (the outline of a disc, a quad with d_1 = 0) and the other diagonal would leave a
  // triangle without area.
  void add_cell(int i, int j) {
    const int a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
    const bool rising = (2 * i + 1 - n_) * (2 * j + 1 - n_) >= 0;
    if (rising) {
      add_triangle(a, b, c);
      add_triangle(a, c, d);
    } else {
      add_triangle(a, b, d);
      add_triangle(b, c, d);
    }
  }

  void add_triangle(int a, int b, int c) {
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }

  int n_;
  std::vector<int> ids_;
  PlaneMesh mesh_;
};

PlaneMesh plane_mesh(const Patch& patch, int resolution) { return Grid(patch, resolution).mesh(); }

OpenMesh::Vec3d open_mesh(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Takes the places u of a curve to the surface in the world frame.
std::vector<Vector3d> lift_to_surface(const Patch& patch, const std::vector<Vector2d>& curve) {
  const Vector3d k = k3(patch);
  const Matrix3d R = axes(patch);
  const Vector3d c = centre(patch);
  std::vector<Vector3d> lifted;
  lifted.reserve(curve.size());
  for (const Vector2d& u : curve) lifted.push_back(R * surface_point(u, k) + c);
  return lifted;
}

// The nearest place that the modelled sheet has a height at: |kappa| rho <= 1 on spheres and cylinders.
Vector2d within_rim(const Patch& patch, const Vector2d& u) {
  const Vector3d k = k3(patch).cwiseAbs();
  if (k.z() == 0.0) return u;  // a paraboloid or a plane
  const double rim = 1.0 / k.z();
  if (patch.type->surface == SurfaceType::circular_cylinder) return {u.x(), std::clamp(u.y(), -rim, rim)};
  const double rho = u.norm();
  return rho > rim ? Vector2d(u * (rim / rho)) : u;
}

}  // namespace

TriangleMesh surface_mesh(const Patch& patch, int resolution) {
  const PlaneMesh plane = plane_mesh(patch, resolution);
  const std::vector<Vector3d> points = lift_to_surface(patch, plane.vertices);
  const Vector3d k = k3(patch);
  const Matrix3d R = axes(patch);
  TriangleMesh mesh;
  mesh.request_vertex_normals();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto vertex = mesh.add_vertex(open_mesh(points[i]));
    mesh.set_normal(vertex, open_mesh(R * outward_normal(surface_point(plane.vertices[i], k), k)));
  }
  for (const auto& [a, b, c] : plane.triangles) {
    mesh.add_face(mesh.vertex_handle(static_cast<unsigned>(a)), mesh.vertex_handle(static_cast<unsigned>(b)),
                  mesh.vertex_handle(static_cast<unsigned>(c)));
  }
  return mesh;
}

std::vector<Vector2d> surface_coordinates(const Patch& patch, int resolution) {
  return plane_mesh(patch, resolution).vertices;
}

std::vector<Vector3d> outline_curve(const Patch& patch, int count) {
  return lift_to_surface(patch, outline(boundary(patch), count));
}

std::vector<Vector3d> offset_curve(const Patch& patch, const std::vector<double>& offsets) {
  const Boundary bound = boundary(patch);
  const auto count = static_cast<double>(offsets.size());
  std::vector<Vector2d> curve;
  curve.reserve(offsets.size());
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const OutlinePoint at = outline_point(bound, static_cast<double>(i) / count);
    curve.push_back(within_rim(patch, at.u + offsets[i] * at.outward));
  }
  return lift_to_surface(patch, curve);
}

}  // namespace patchlab
