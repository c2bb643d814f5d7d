// Binary STL of triangles: also the collision meshes of worlds.
#pragma once

#include <span>
#include <string>

#include "engine/export/triangles.h"

namespace patchlab {

// The triangles of all meshes, in single precision, each with its own normal.
std::string stl_bytes(std::span<const Triangles> meshes);

}  // namespace patchlab
