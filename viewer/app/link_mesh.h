// The shape of a robot's link as triangles, in the frame of the link.
#pragma once

#include "engine/io/mesh_data.h"
#include "engine/map/robot.h"
#include "viewer/render/scene.h"

namespace patchlab::viewer {

struct LinkTriangles {
  std::vector<Eigen::Vector3d> points, normals;  // m
  std::vector<std::uint32_t> triangles;
};
// `mesh` is that of a mesh shape; nothing to draw without it.
LinkTriangles link_triangles(const LinkShape& shape, const MeshData* mesh);

// Moved to where the link is.
MeshItem link_item(const LinkTriangles& link, const Pose& world_from_link, const Eigen::Vector3d& origin,
                   const Rgba& colour);

}  // namespace patchlab::viewer
