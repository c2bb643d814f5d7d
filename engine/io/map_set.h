// A patch map as a patch set: the fused patches with an `observations` list each, so that a map saves, loads
// and goes on, and every reader of patch sets reads it.
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/io/patch_set.h"
#include "engine/map/patch_map.h"

namespace patchlab {

// Says in the file that a pose or joints that the patches share correlate their errors (`correlations`).
void state_shared_errors(PatchSet& set);

// The map of a set. A set without observations is one whose patches were seen once, in their source. usage
// error where its patches stand in several frames.
Result<PatchMap> map_of(const PatchSet& set, const std::string& name);

// `map` written over `set`, which holds the sources and what else the records of the patches say; patches
// that are not in the set yet are taken from `added` by the source and id of their first observation.
PatchSet set_of(const PatchMap& map, const PatchSet& set, const PatchSet& added);

}  // namespace patchlab
