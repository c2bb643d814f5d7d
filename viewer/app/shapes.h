// Meshes and curves of the shapes that stand for an uncertainty. Positions in metre about `origin` of the
// scene.
#pragma once

#include <vector>

#include "engine/patch/marginals.h"
#include "viewer/render/scene.h"

namespace patchlab::viewer {

// The ellipsoid, `times` larger. A flat one is drawn flat.
MeshItem ellipsoid_mesh(const Ellipsoid& ellipsoid, double times, const Eigen::Vector3d& origin,
                        const Rgba& colour);
// Many of them as one mesh, coarser each.
MeshItem ellipsoids_mesh(const std::vector<Ellipsoid>& ellipsoids, double times,
                         const Eigen::Vector3d& origin, const Rgba& colour);
// Its three principal ellipses.
std::vector<LineItem> ellipsoid_rims(const Ellipsoid& ellipsoid, double times, const Eigen::Vector3d& origin,
                                     const Rgba& colour, float width);

// The rim of the cone at `height` above the apex, its half angles `times` larger; closed, counterclockwise.
std::vector<Eigen::Vector3d> cone_rim(const NormalCone& cone, double times, double height);
MeshItem cone_mesh(const NormalCone& cone, const std::vector<Eigen::Vector3d>& rim,
                   const Eigen::Vector3d& origin, const Rgba& colour);

// The strip between two closed curves of the same size.
MeshItem strip_mesh(const std::vector<Eigen::Vector3d>& one, const std::vector<Eigen::Vector3d>& other,
                    const Eigen::Vector3d& origin, const Rgba& colour);

std::vector<Eigen::Vector3f> about(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& origin);

}  // namespace patchlab::viewer
