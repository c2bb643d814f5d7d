#include "engine/io/map_set.h"

#include <algorithm>

#include "engine/base/printable.h"
#include "engine/io/json.h"
#include "engine/io/patch_json.h"

namespace patchlab {
namespace {

constexpr const char* member = "observations";

nlohmann::json observation_json(const Observation& seen) {
  nlohmann::ordered_json out = {
      {"source", seen.source}, {"patch", seen.id}, {"chi2", seen.chi2}, {"dof", seen.dof}};
  if (!seen.when.empty()) out["when"] = seen.when;
  append_patch(out, seen.patch);
  return out;
}

Observation observation_from_json(const JsonPlace& place) {
  Observation seen;
  seen.source = place["source"].text();
  seen.id = place["patch"].text();
  seen.chi2 = place["chi2"].number();
  seen.dof = static_cast<int>(place["dof"].whole_number(1000));
  if (const auto when = place.find("when")) seen.when = when->text();
  seen.patch = patch_from_json(place);
  return seen;
}

std::vector<Observation> observations_of(const PatchRecord& record, const std::string& name,
                                         std::optional<Error>& error) {
  if (!record.unknown.contains(member)) return {{record.source, record.id, record.patch, 0.0, 0}};
  std::vector<Observation> out;
  const JsonPlace list =
      JsonPlace(record.unknown[member], name, error).called("observations of patch \"" + record.id + "\"");
  for (const JsonPlace& place : list.items()) out.push_back(observation_from_json(place));
  if (out.empty() && list.ok()) list.fail("are none; a patch of a map was seen once at least");
  return out;
}

const PatchRecord* find_record(const PatchSet& set, const std::string& id) {
  const auto at = std::ranges::find(set.patches, id, &PatchRecord::id);
  return at == set.patches.end() ? nullptr : &*at;
}

PatchRecord record_of(const MapPatch& patch, const std::string& frame, const PatchSet& set,
                      const PatchSet& added) {
  const PatchRecord* known = find_record(set, patch.id);
  if (known == nullptr) known = find_record(added, patch.observations.front().id);
  PatchRecord record = known == nullptr ? PatchRecord{} : *known;
  record.id = patch.id;
  record.frame_id = frame;
  record.patch = patch.patch;
  nlohmann::json list = nlohmann::json::array();
  for (const Observation& seen : patch.observations) list.push_back(observation_json(seen));
  record.unknown[member] = list;
  record.unknown["bound_derived"] = patch.observations.size() > 1;
  if (patch.observations.size() > 1) record.fit.reset();  // it was of one of them
  return record;
}

}  // namespace

void state_shared_errors(PatchSet& set) { set.unknown["correlations"] = "patches_share_errors"; }

Result<PatchMap> map_of(const PatchSet& set, const std::string& name) {
  PatchMap map;
  std::optional<Error> error;
  for (const PatchRecord& record : set.patches) {
    if (map.patches.empty()) map.frame = record.frame_id;
    if (record.frame_id != map.frame) {
      return Error{ErrorCode::usage, name + ": patches stand in frames \"" + printable(map.frame) +
                                         "\" and \"" + printable(record.frame_id) +
                                         "\"; a map has one frame, so bring them into one first."};
    }
    map.patches.push_back({record.id, record.patch, observations_of(record, name, error)});
    if (error) return *error;
  }
  return map;
}

PatchSet set_of(const PatchMap& map, const PatchSet& set, const PatchSet& added) {
  PatchSet out;
  out.unknown = set.unknown;
  if (added.unknown.contains("correlations")) state_shared_errors(out);
  out.sources = set.sources;
  for (const PatchSource& source : added.sources) {
    if (std::ranges::find(out.sources, source.id, &PatchSource::id) == out.sources.end())
      out.sources.push_back(source);
  }
  for (const MapPatch& patch : map.patches) out.patches.push_back(record_of(patch, map.frame, set, added));
  return out;
}

View view_of(const PatchSet& set, const UncertainPose& map_from_view) {
  View view{{}, {}, {}, map_from_view};
  for (const PatchRecord& record : set.patches) {
    view.sources.push_back(record.source);
    view.ids.push_back(record.id);
    view.patches.push_back(record.patch);
  }
  return view;
}

void rename_sources(const PatchSet& map, PatchSet& view) {
  for (PatchSource& source : view.sources) {
    const std::string old = source.id;
    for (const PatchSource& other : map.sources) {
      if (other.id == source.id && other.sha256 != source.sha256)
        source.id += "@" + source.sha256.substr(0, 8);
    }
    for (PatchRecord& record : view.patches) {
      if (record.source == old) record.source = source.id;
    }
  }
}

Result<void> check_unseen(const PatchMap& map, const PatchSet& view, const std::string& map_name,
                          const std::string& view_name) {
  for (const MapPatch& patch : map.patches) {
    for (const Observation& seen : patch.observations) {
      for (const PatchRecord& record : view.patches) {
        if (record.source.empty() || record.source != seen.source || record.id != seen.id) continue;
        return Error{ErrorCode::usage,
                     view_name + ": patch \"" + record.id + "\" is in " + map_name +
                         " already, from the same source; a sight counts once, so leave it out."};
      }
    }
  }
  return {};
}

}  // namespace patchlab
