// What several verbs of `patchlab map` read: patch sets, and the pose between two of them.
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/io/patch_set.h"
#include "engine/map/patch_map.h"
#include "engine/pose/chain.h"

namespace patchlab {

std::string called(const std::string& file);  // in messages: "-" is standard input
Result<PatchSet> read_set(const std::string& file);

// A map and the file that it is of.
struct MapFile {
  const std::string& file;
  const PatchMap& map;
};
// Where b stands in a: by the file `pose`, or both in one frame. usage error where it is neither.
Result<UncertainPose> pose_between(const std::string& pose, const MapFile& a, const MapFile& b);

}  // namespace patchlab
