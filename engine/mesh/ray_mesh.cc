#include "engine/mesh/ray_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlab {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr std::uint32_t triangles_a_leaf = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

// A ray in axes where it runs along z, sheared rather than turned: the edge functions of two triangles at one
// edge are then the same product with the other sign, so that every ray is on one side of it (Woop, Benthin
// and Wald 2013).
class ShearedRay {
 public:
  ShearedRay(const Vector3d& origin, const Vector3d& direction)
      : origin_(origin), inverse_(direction.cwiseInverse()) {
    direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    shear_ = Vector3d(direction[x_], direction[y_], 1.0) / direction[z_];
  }

  // s of the point of the triangle on the ray; infinity where there is none.
  double hit(const Vector3d& corner_a, const Vector3d& corner_b, const Vector3d& corner_c) const {
    const Vector3d a = sheared(corner_a), b = sheared(corner_b), c = sheared(corner_c);
    const double u = c.x() * b.y() - c.y() * b.x(), v = a.x() * c.y() - a.y() * c.x(),
                 w = b.x() * a.y() - b.y() * a.x();
    const double area = u + v + w;
    if (std::min({u, v, w}) < 0.0 && std::max({u, v, w}) > 0.0) return infinity;
    if (area == 0.0) return infinity;
    const double s = (u * a.z() + v * b.z() + w * c.z()) / area;
    return s > 0.0 ? s : infinity;
  }

  // s where the ray enters the box, at least 0; infinity where it misses it. Widened by what rounding may
  // lose.
  double enter(const AlignedBox3d& box) const {
    constexpr double wider = 1.0 + 4.0 * std::numeric_limits<double>::epsilon();
    double in = 0.0, out = infinity;
    for (int axis = 0; axis < 3; ++axis) {
      const double one = (box.min()[axis] - origin_[axis]) * inverse_[axis],
                   other = (box.max()[axis] - origin_[axis]) * inverse_[axis];
      if (std::isnan(one) || std::isnan(other)) continue;  // within a side of the box, and along it
      in = std::max(in, std::min(one, other));
      out = std::min(out, std::max(one, other) * wider);
    }
    return in <= out ? in : infinity;
  }

 private:
  Vector3d sheared(const Vector3d& corner) const {
    const Vector3d from_origin = corner - origin_;
    const double depth = from_origin[z_];
    return {from_origin[x_] - shear_.x() * depth, from_origin[y_] - shear_.y() * depth, shear_.z() * depth};
  }

  Vector3d origin_, inverse_, shear_;
  int x_ = 0, y_ = 1, z_ = 2;
};

}  // namespace

RayMesh::RayMesh(std::vector<Vector3d> vertices, std::vector<Triangle> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  std::erase_if(triangles_, [&](const Triangle& triangle) {
    return !std::ranges::all_of(triangle, [&](std::uint32_t i) { return vertices_[i].allFinite(); });
  });
  Node root;
  root.count = static_cast<std::uint32_t>(triangles_.size());
  for (const Triangle& triangle : triangles_) root.box.extend(box_of(triangle));
  nodes_.push_back(root);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
}

AlignedBox3d RayMesh::box_of(const Triangle& triangle) const {
  AlignedBox3d box;
  for (const std::uint32_t corner : triangle) box.extend(vertices_[corner]);
  return box;
}

// Into the halves with the lower and the higher middles along the longest side.
void RayMesh::split(std::uint32_t node) {
  const Node whole = nodes_[node];
  if (whole.count <= triangles_a_leaf) return;
  int axis = 0;
  whole.box.sizes().maxCoeff(&axis);
  const auto begin = triangles_.begin() + whole.first, middle = begin + whole.count / 2,
             end = begin + whole.count;
  std::nth_element(begin, middle, end, [&](const Triangle& a, const Triangle& b) {
    return box_of(a).center()[axis] < box_of(b).center()[axis];
  });
  Node low, high;
  low.first = whole.first;
  low.count = whole.count / 2;
  high.first = whole.first + low.count;
  high.count = whole.count - low.count;
  for (auto triangle = begin; triangle != end; ++triangle)
    (triangle < middle ? low : high).box.extend(box_of(*triangle));
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].count = 0;
  nodes_.push_back(low);
  nodes_.push_back(high);
}

std::optional<double> RayMesh::hit(const Vector3d& origin, const Vector3d& direction) const {
  constexpr std::size_t deepest =
      64;  // halves of 2^32 triangles lie 32 deep, and a node leaves one beside it
  const ShearedRay ray(origin, direction);
  std::array<std::uint32_t, deepest> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  double nearest = infinity;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    if (node.box.isEmpty() || ray.enter(node.box) >= nearest) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& [a, b, c] = triangles_[i];
      nearest = std::min(nearest, ray.hit(vertices_[a], vertices_[b], vertices_[c]));
    }
    if (node.count > 0) continue;
    const bool low_first = ray.enter(nodes_[node.first].box) <= ray.enter(nodes_[node.first + 1].box);
    waiting[count++] = node.first + (low_first ? 1 : 0);
    waiting[count++] = node.first + (low_first ? 0 : 1);
  }
  return std::isfinite(nearest) ? std::optional(nearest) : std::nullopt;
}

}  // namespace patchlab
