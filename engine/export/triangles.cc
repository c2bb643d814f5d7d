#include "engine/export/triangles.h"

#include <set>

#include "engine/mesh/patch_mesh.h"

namespace patchlab {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// The edges of the faces that no other face runs along in the opposite direction.
std::vector<Edge> rim(const std::vector<std::array<std::uint32_t, 3>>& faces) {
  std::set<Edge> edges;
  for (const auto& [a, b, c] : faces) edges.insert({{a, b}, {b, c}, {c, a}});
  std::vector<Edge> rim;
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) rim.emplace_back(a, b);
  }
  return rim;
}

}  // namespace

Triangles open_surface(const Patch& patch, int resolution) {
  const Vector3d k = k3(patch);
  const TriangleMesh mesh = surface_mesh(patch, resolution);
  Triangles out;
  out.u = surface_coordinates(patch, resolution);
  for (const Vector2d& u : out.u) {
    out.points.push_back(surface_point(u, k));
    out.normals.push_back(outward_normal(out.points.back(), k));
  }
  for (const auto face : mesh.faces()) {
    auto corner = mesh.cfv_ccwbegin(face);
    auto& written = out.faces.emplace_back();
    for (std::uint32_t& index : written) index = static_cast<std::uint32_t>((corner++)->idx());
  }
  return out;
}

Triangles thick_solid(const Patch& patch, double thickness, int resolution) {
  Triangles out = open_surface(patch, resolution);
  const std::vector<Edge> edges = rim(out.faces);
  const std::size_t faces = out.faces.size(), points = out.points.size();
  const auto under = static_cast<std::uint32_t>(points);
  for (std::size_t i = 0; i < points; ++i) {
    out.points.push_back(out.points[i] - thickness * Vector3d::UnitZ());
    out.normals.push_back(-out.normals[i]);
    out.u.push_back(Vector2d(out.u[i]));
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const auto [a, b, c] = out.faces[i];
    out.faces.push_back({under + a, under + c, under + b});
  }
  for (const auto& [a, b] : edges) {
    out.faces.push_back({b, a, under + a});
    out.faces.push_back({b, under + a, under + b});
  }
  return out;
}

Triangles placed_triangles(const Patch& patch, const ExportOptions& options) {
  Triangles out = options.thickness ? thick_solid(patch, *options.thickness) : open_surface(patch);
  const Matrix3d R = axes(patch);
  const Vector3d c = centre(patch);
  for (Vector3d& point : out.points) point = R * point + c;
  for (Vector3d& normal : out.normals) normal = R * normal;
  return out;
}

}  // namespace patchlab
