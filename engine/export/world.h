// What collision worlds share: each patch as a thick mesh in its own frame.
#pragma once

#include <string>
#include <vector>

#include "engine/export/export.h"
#include "engine/export/text.h"

namespace patchlab {

struct WorldPatch {
  const Patch* patch;
  std::string id;    // for XML: escaped, unique
  std::string file;  // "p0_left_sole", without folder and extension
  bool concave;      // some of it rises by more than 10 micrometre above its tangent plane
};

inline constexpr double default_thickness = 0.005;  // m

struct World {
  std::string frame;  // escaped; "world" where the patches name none
  double thickness;   // m
  std::vector<WorldPatch> patches;
};
// refused error where the patches stand in several frames.
Result<World> world_of(const PatchSet& set, const ExportOptions& options, std::string_view format);

// Binary STL of the solid, in the patch's own frame.
ExportedFile mesh_file(const World& world, const WorldPatch& patch);

}  // namespace patchlab
