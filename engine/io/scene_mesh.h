// A mesh among the objects of a scene: {"mesh": "can.obj", "unit": "mm", "pose": {...}}.
#pragma once

#include <filesystem>
#include <memory>

#include "engine/io/json.h"
#include "engine/mesh/ray_mesh.h"

namespace patchlab {

// The mesh of the object at `object`, in the world frame: its file, from `folder` on where the path is
// relative, its unit (metre where none is said) and its pose in the world (where none is said, the file's own
// frame). Anything wrong is told through `object`; the mesh is then null.
std::shared_ptr<const RayMesh> mesh_from_json(const JsonPlace& object, const std::filesystem::path& folder);

}  // namespace patchlab
