// The patches of a set as one triangle mesh, for viewers of meshes.
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/io/patch_set.h"

namespace patchlab {

// PLY, binary little-endian, doubles. A vertex has x y z (m, in the frame of its patch), nx ny nz (outward),
// height_sigma (m: standard deviation of the height along the normal, from the covariance of curvature and
// pose; -1 where the patch has no covariance) and patch (its number in the set, from 0). Comments name each
// patch, its type and its frame. refused error for a patch that is not valid.
Result<std::string> write_ply(const PatchSet& set);

}  // namespace patchlab
