// A patch as triangles in its own frame: an open surface, or a solid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/export/export.h"

namespace patchlab {

struct Triangles {
  std::vector<Vector3d> points;   // m
  std::vector<Vector3d> normals;  // of the surface, outward; of the underside of a solid, opposite
  std::vector<Vector2d> u;        // the place on the surface that the vertex belongs to
  std::vector<std::array<std::uint32_t, 3>> faces;  // counterclockwise seen from outside
};

// The surface, clipped exactly to its outline.
Triangles open_surface(const Patch& patch, int resolution = 32);
// The same moved by `thickness` along -z_l as its underside, and a wall around both: closed, each edge in two
// triangles of opposite direction. The upper side is that of open_surface, vertex for vertex.
Triangles thick_solid(const Patch& patch, double thickness, int resolution = 32);

// As the options ask, in the frame that the patch stands in.
Triangles placed_triangles(const Patch& patch, const ExportOptions& options);

}  // namespace patchlab
