// Triangles that rays hit, in a tree of boxes: what a simulated camera sees of a mesh.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace patchlab {

// Opaque from both sides. Where two triangles share an edge no ray slips through between them.
class RayMesh {
 public:
  using Triangle = std::array<std::uint32_t, 3>;  // indices of vertices

  // Precondition: the triangles name vertices that are there. Triangles without an area, and those with a
  // corner that is not finite, are never hit.
  RayMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles);

  // The least s > 0 at which origin + s direction lies on a triangle.
  std::optional<double> hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  std::size_t size() const { return triangles_.size(); }
  const Eigen::AlignedBox3d& box() const { return nodes_[0].box; }  // empty where there are no triangles

 private:
  // A leaf has triangles [first, first + count); any other node its children at first and first + 1.
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0, count = 0;
  };
  void split(std::uint32_t node);
  Eigen::AlignedBox3d box_of(const Triangle& triangle) const;

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace patchlab
