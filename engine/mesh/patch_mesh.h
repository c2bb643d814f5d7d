// Patches as triangles (OpenMesh) and curves, for drawing and for export.
#pragma once

#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <vector>

#include "engine/patch/patch.h"

namespace patchlab {

struct PatchMeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<PatchMeshTraits>;

// The surface of the patch as triangles in the world frame, clipped exactly to its outline: every boundary
// vertex lies on the outline curve; counterclockwise seen from the outward side; vertex normals are the
// surface's own, outward. `resolution` is the number of cells along the longer side.
TriangleMesh surface_mesh(const Patch& patch, int resolution = 32);

// The local coordinates u of each vertex of surface_mesh, in the same order: for colouring by height sigma.
std::vector<Vector2d> surface_coordinates(const Patch& patch, int resolution = 32);

// The outline on the surface in the world frame, closed (the first point is not repeated), counterclockwise
// about z_l.
std::vector<Vector3d> outline_curve(const Patch& patch, int count = 128);

// The outline moved across itself in the xy plane of the patch by offsets[i] (m, outward positive) at the
// fraction i / offsets.size() of its way round, on the surface; not beyond the rim of a sphere or cylinder.
// With the points of outline_band(patch, count) the edges of a band are offset_curve(patch, +k sigma) and
// offset_curve(patch, -k sigma).
std::vector<Vector3d> offset_curve(const Patch& patch, const std::vector<double>& offsets);

}  // namespace patchlab
