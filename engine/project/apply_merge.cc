#include <algorithm>

#include "engine/io/map_set.h"
#include "engine/project/map_commands.h"
#include "engine/project/placed.h"

namespace patchlab {
namespace {

Error refusal(std::string message) { return {ErrorCode::usage, std::move(message)}; }

PatchSet set_of_scan(const Document& document, const std::string& scan) {
  PatchSet all = patch_set(document);
  std::erase_if(all.sources, [&](const PatchSource& source) { return source.id != scan; });
  std::erase_if(all.patches, [&](const PatchRecord& record) { return record.source != scan; });
  return all;
}

Result<PatchSet> set_to_merge(const Document& document, const std::string& id) {
  if (const MapEntry* map = find_map(document, id)) return *map->set;
  if (!find_scan(document, id)) return refusal("There is no map or scan '" + id + "'.");
  PatchSet set = set_of_scan(document, id);
  if (set.patches.empty()) return refusal("No patch is fitted to '" + id + "' yet.");
  return set;
}

// The matches that were not refused. usage error for a refused pair that is none of them.
Result<std::vector<Match>> accepted(const MergeProposal& proposal, const Merge& merge) {
  std::vector<Match> matches = proposal.found.matches;
  for (const std::array<std::string, 2>& pair : merge.refused) {
    const std::size_t erased = std::erase_if(matches, [&](const Match& match) {
      return proposal.map.patches[match.a].id == pair[0] && proposal.view.ids[match.b] == pair[1];
    });
    if (erased == 0) return refusal("'" + pair[0] + "' and '" + pair[1] + "' are no match to refuse.");
  }
  return matches;
}

}  // namespace

Result<MergeProposal> propose_merge(const Document& document, const std::string& map, const std::string& view,
                                    double gate) {
  if (map == view) return refusal("'" + map + "' cannot be merged into itself.");
  Result<PatchSet> added = set_to_merge(document, view);
  if (!added) return added.error();
  MergeProposal out;
  if (const MapEntry* entry = find_map(document, map)) {
    out.map = *entry->map;
    out.set = *entry->set;
  } else if (is_taken(document, map)) {
    return refusal("'" + map + "' is no map.");
  }
  rename_sources(out.set, *added);
  if (out.map.frame.empty()) out.map.frame = added->patches.empty() ? "" : added->patches.front().frame_id;
  const std::string from = added->patches.empty() ? out.map.frame : added->patches.front().frame_id;
  const Result<UncertainPose> pose = pose_between(document, out.map.frame, from);
  if (!pose) return pose.error();
  if (const Result<void> unseen = check_unseen(out.map, *added, map, view); !unseen) return unseen.error();
  out.view = view_of(*added, *pose);
  out.added = std::move(*added);
  out.found = associate(patches_of(out.map), out.view.patches, *pose, {.gate = gate});
  return out;
}

Result<void> run(Merge& merge, Document& document, const ApplyOptions&) {
  if (merge.map.empty()) merge.map = free_id(document, "map");
  Result<MergeProposal> proposal = propose_merge(document, merge.map, merge.view, merge.gate);
  if (!proposal) return proposal.error();
  const Result<std::vector<Match>> matches = accepted(*proposal, merge);
  if (!matches) return matches.error();
  proposal->view.when = merge.when;
  const Merged merged = patchlab::merge(proposal->map, proposal->view, *matches);
  PatchSet set = set_of(merged.map, proposal->set, proposal->added);
  if (!proposal->view.map_from_view.covariance.isZero(0.0)) state_shared_errors(set);
  std::erase_if(document.maps, [&](const MapEntry& entry) { return entry.id == merge.view; });
  auto entry = std::ranges::find(document.maps, merge.map, &MapEntry::id);
  if (entry == document.maps.end()) {
    document.maps.push_back({merge.map, merge.map, {}, {}, true});
    entry = document.maps.end() - 1;
  }
  entry->map = std::make_shared<const PatchMap>(merged.map);
  entry->set = std::make_shared<const PatchSet>(std::move(set));
  return {};
}

}  // namespace patchlab
