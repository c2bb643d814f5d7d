#include "viewer/app/shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "viewer/panel/colours.h"

namespace patchlab::viewer {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::uint32_t rim_points = 64;
constexpr double full_turn = 2 * std::numbers::pi;

MeshItem item(std::vector<MeshVertex> vertices, std::vector<std::uint32_t> triangles, bool lit) {
  return {std::make_shared<const std::vector<MeshVertex>>(std::move(vertices)),
          std::make_shared<const std::vector<std::uint32_t>>(std::move(triangles)), lit};
}

// Half lengths that keep a normal where the ellipsoid is flat.
Vector3d kept_thick(const Vector3d& half_lengths) {
  return half_lengths.cwiseMax(1e-3 * std::max(half_lengths.maxCoeff(), 1e-9));
}

struct Triangles {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> triangles;
};
struct Grid {
  std::uint32_t meridians, parallels;
};

void add_ellipsoid(const Ellipsoid& ellipsoid, double times, const Vector3d& origin, const Rgba& colour,
                   const Grid& grid, Triangles& mesh) {
  const Vector3d half = kept_thick(times * ellipsoid.half_lengths);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i <= grid.parallels; ++i) {
    const double polar = std::numbers::pi * i / grid.parallels;
    for (std::uint32_t j = 0; j <= grid.meridians; ++j) {
      const double around = full_turn * j / grid.meridians;
      const Vector3d unit(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                          std::cos(polar));
      const Vector3d normal = (ellipsoid.axes * unit.cwiseQuotient(half)).normalized();
      const Vector3d point = ellipsoid.centre + ellipsoid.axes * unit.cwiseProduct(half) - origin;
      mesh.vertices.push_back({point.cast<float>(), normal.cast<float>(), to_bytes(colour)});
      if (i == grid.parallels || j == grid.meridians) continue;
      const std::uint32_t a = first + i * (grid.meridians + 1) + j, b = a + grid.meridians + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
}

}  // namespace

std::vector<Vector3f> about(const std::vector<Vector3d>& points, const Vector3d& origin) {
  std::vector<Vector3f> moved;
  moved.reserve(points.size());
  for (const Vector3d& point : points) moved.push_back((point - origin).cast<float>());
  return moved;
}

MeshItem ellipsoid_mesh(const Ellipsoid& ellipsoid, double times, const Vector3d& origin,
                        const Rgba& colour) {
  Triangles mesh;
  add_ellipsoid(ellipsoid, times, origin, colour, {48, 24}, mesh);
  return item(std::move(mesh.vertices), std::move(mesh.triangles), true);
}

MeshItem ellipsoids_mesh(const std::vector<Ellipsoid>& ellipsoids, double times, const Vector3d& origin,
                         const Rgba& colour) {
  Triangles mesh;
  for (const Ellipsoid& each : ellipsoids) add_ellipsoid(each, times, origin, colour, {12, 7}, mesh);
  return item(std::move(mesh.vertices), std::move(mesh.triangles), true);
}

std::vector<LineItem> ellipsoid_rims(const Ellipsoid& ellipsoid, double times, const Vector3d& origin,
                                     const Rgba& colour, float width) {
  std::vector<LineItem> rims;
  for (int k = 0; k < 3; ++k) {
    const Vector3d u = times * ellipsoid.half_lengths[k] * ellipsoid.axes.col(k);
    const Vector3d v = times * ellipsoid.half_lengths[(k + 1) % 3] * ellipsoid.axes.col((k + 1) % 3);
    std::vector<Vector3d> points;
    for (std::uint32_t i = 0; i < rim_points; ++i) {
      const double t = full_turn * i / rim_points;
      points.push_back(ellipsoid.centre + std::cos(t) * u + std::sin(t) * v);
    }
    rims.push_back({about(points, origin), colour, width, true, true, 0.6f});
  }
  return rims;
}

std::vector<Vector3d> cone_rim(const NormalCone& cone, double times, double height) {
  std::vector<Vector3d> rim;
  for (std::uint32_t i = 0; i < rim_points; ++i) {
    const double t = full_turn * i / rim_points;
    // A rotation by a about an axis moves the normal by a x z.
    const Vector3d turn = times * (std::cos(t) * cone.half_angles[0] * cone.axes.col(0) +
                                   std::sin(t) * cone.half_angles[1] * cone.axes.col(1));
    const double angle = turn.norm();
    const Vector3d across =
        angle > 0 ? Vector3d(turn.cross(cone.normal) / angle) : Vector3d(Vector3d::Zero());
    rim.push_back(cone.apex + height * (std::cos(angle) * cone.normal + std::sin(angle) * across));
  }
  return rim;
}

MeshItem cone_mesh(const NormalCone& cone, const std::vector<Vector3d>& rim, const Vector3d& origin,
                   const Rgba& colour) {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> triangles;
  const Vector3f apex = (cone.apex - origin).cast<float>();
  const Rgba8 bytes = to_bytes(colour);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::size_t next = (i + 1) % rim.size();
    const Vector3d normal = (rim[i] - cone.apex).cross(rim[next] - cone.apex).normalized();
    for (const Vector3f& position :
         {apex, Vector3f((rim[i] - origin).cast<float>()), Vector3f((rim[next] - origin).cast<float>())}) {
      triangles.push_back(static_cast<std::uint32_t>(vertices.size()));
      vertices.push_back({position, normal.cast<float>(), bytes});
    }
  }
  return item(std::move(vertices), std::move(triangles), false);
}

MeshItem strip_mesh(const std::vector<Vector3d>& one, const std::vector<Vector3d>& other,
                    const Vector3d& origin, const Rgba& colour) {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> triangles;
  const auto count = static_cast<std::uint32_t>(one.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const Vector3d& point : {one[i], other[i]}) {
      vertices.push_back({(point - origin).cast<float>(), Vector3f::UnitZ(), to_bytes(colour)});
    }
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
    triangles.insert(triangles.end(), {a, b, a + 1, a + 1, b, b + 1});
  }
  return item(std::move(vertices), std::move(triangles), false);
}

}  // namespace patchlab::viewer
