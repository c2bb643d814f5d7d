#include "viewer/app/link_mesh.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "viewer/panel/colours.h"

namespace patchlab::viewer {

namespace {

using Eigen::Vector3d;

constexpr std::uint32_t around = 40, upwards = 20;  // facets of round shapes
constexpr double drawn_share = 0.98;  // of the size: patches that are designed on a link lie before it

void add_corner(LinkTriangles& mesh, const Vector3d& point, const Vector3d& normal) {
  mesh.triangles.push_back(static_cast<std::uint32_t>(mesh.points.size()));
  mesh.points.push_back(point);
  mesh.normals.push_back(normal);
}

void add_flat(LinkTriangles& mesh, const std::array<Vector3d, 3>& corners) {
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  for (const Vector3d& corner : corners) add_corner(mesh, corner, normal);
}

LinkTriangles box(const Vector3d& sides) {
  LinkTriangles mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.5, 0.5}) {
      Vector3d middle = Vector3d::Zero(), u = Vector3d::Zero(), v = Vector3d::Zero();
      middle[axis] = side * sides[axis];
      u[(axis + 1) % 3] = 0.5 * sides[(axis + 1) % 3];
      v[(axis + 2) % 3] = (side > 0 ? 0.5 : -0.5) * sides[(axis + 2) % 3];
      add_flat(mesh, {middle - u - v, middle + u - v, middle + u + v});
      add_flat(mesh, {middle - u - v, middle + u + v, middle - u + v});
    }
  }
  return mesh;
}

Vector3d on_circle(std::uint32_t i) {
  const double turn = 2 * std::numbers::pi * i / around;
  return {std::cos(turn), std::sin(turn), 0.0};
}

LinkTriangles cylinder(double radius, double length) {
  LinkTriangles mesh;
  const Vector3d top(0, 0, 0.5 * length);
  for (std::uint32_t i = 0; i < around; ++i) {
    const Vector3d a = on_circle(i), b = on_circle(i + 1);
    const Vector3d p = radius * a, q = radius * b;
    const std::array<std::pair<Vector3d, Vector3d>, 6> side = {
        {{p - top, a}, {q - top, b}, {q + top, b}, {p - top, a}, {q + top, b}, {p + top, a}}};
    for (const auto& [point, normal] : side) add_corner(mesh, point, normal);
    add_flat(mesh, {top, p + top, q + top});
    add_flat(mesh, {-top, q - top, p - top});
  }
  return mesh;
}

LinkTriangles ball(double radius) {
  LinkTriangles mesh;
  const auto at = [](std::uint32_t i, std::uint32_t j) {
    const double polar = std::numbers::pi * i / upwards;
    return Vector3d(std::sin(polar) * on_circle(j) + Vector3d(0, 0, std::cos(polar)));
  };
  for (std::uint32_t i = 0; i < upwards; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      for (const Vector3d& normal :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        add_corner(mesh, radius * normal, normal);
    }
  }
  return mesh;
}

LinkTriangles from_file(const MeshData* data, const Vector3d& scale) {
  LinkTriangles mesh;
  if (!data) return mesh;
  for (const std::array<std::uint32_t, 3>& face : data->triangles) {
    const auto corner = [&](std::size_t k) { return Vector3d(scale.cwiseProduct(data->vertices[face[k]])); };
    add_flat(mesh, {corner(0), corner(1), corner(2)});
  }
  return mesh;
}

LinkTriangles in_shape(const LinkShape& shape, const MeshData* mesh) {
  switch (shape.kind) {
    case LinkShapeKind::box:
      return box(shape.size);
    case LinkShapeKind::cylinder:
      return cylinder(shape.size.x(), shape.size.z());
    case LinkShapeKind::sphere:
      return ball(shape.size.x());
    case LinkShapeKind::mesh:
      return from_file(mesh, shape.size);
  }
  return {};
}

}  // namespace

LinkTriangles link_triangles(const LinkShape& shape, const MeshData* data) {
  LinkTriangles mesh = in_shape(shape, data);
  for (Vector3d& point : mesh.points) point *= drawn_share;
  const Eigen::Matrix3d R = exp_map(shape.link_from_shape.r);
  for (Vector3d& point : mesh.points) point = apply(shape.link_from_shape, point);
  for (Vector3d& normal : mesh.normals) normal = R * normal;
  return mesh;
}

MeshItem link_item(const LinkTriangles& link, const Pose& world_from_link, const Vector3d& origin,
                   const Rgba& colour) {
  const Eigen::Matrix3d R = exp_map(world_from_link.r);
  const Rgba8 bytes = to_bytes(colour);
  std::vector<MeshVertex> vertices;
  vertices.reserve(link.points.size());
  for (std::size_t i = 0; i < link.points.size(); ++i) {
    vertices.push_back({(R * link.points[i] + world_from_link.t - origin).cast<float>(),
                        (R * link.normals[i]).cast<float>(), bytes});
  }
  return {std::make_shared<const std::vector<MeshVertex>>(std::move(vertices)),
          std::make_shared<const std::vector<std::uint32_t>>(link.triangles), true};
}

}  // namespace patchlab::viewer
