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

// The patches of a set as a view to merge, and what has to hold before: its sources have ids of their own
// where those of the map mean other scans, and none of its sights is in the map already.
View view_of(const PatchSet& set, const UncertainPose& map_from_view);
void rename_sources(const PatchSet& map, PatchSet& view);
// usage error that names the first sight which the map holds: a sight counts once.
Result<void> check_unseen(const PatchMap& map, const PatchSet& view, const std::string& map_name,
                          const std::string& view_name);

}  // namespace patchlab
