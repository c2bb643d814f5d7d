#include "engine/project/document.h"

#include <algorithm>

namespace patchlab {
namespace {

template <class Entry>
const Entry* find(const std::vector<Entry>& entries, const std::string& id) {
  const auto found = std::ranges::find(entries, id, &Entry::id);
  return found == entries.end() ? nullptr : &*found;
}

bool is_identity(const Viewpoint& viewpoint) {
  return viewpoint.position.isZero(0.0) && rotation(viewpoint).isIdentity(1e-12);
}

PatchSource source(const ScanEntry& entry) {
  return {entry.id,
          entry.scan->file,
          entry.sha256,
          entry.noise.specification,
          entry.noise.assumed,
          entry.scan->viewpoint};
}

PatchRecord record(const Document& document, const PatchEntry& entry, const std::string& journal) {
  PatchRecord record;
  record.id = entry.id;
  record.name = entry.name;
  record.source = entry.scan;
  record.frame_id = frame_of(*find_scan(document, entry.scan));
  record.patch = entry.fit->patch;
  record.fit = FitSummary(entry.fit->report);
  record.provenance = {{"region", entry.region}};
  if (!journal.empty()) record.provenance["journal"] = journal;
  return record;
}

}  // namespace

const ScanEntry* find_scan(const Document& document, const std::string& id) {
  return find(document.scans, id);
}
const RegionEntry* find_region(const Document& document, const std::string& id) {
  return find(document.regions, id);
}
const PatchEntry* find_patch(const Document& document, const std::string& id) {
  return find(document.patches, id);
}

std::optional<std::string> notice_of_other_results(const Document& document) {
  std::string names;
  int count = 0;
  for (const PatchEntry& patch : document.patches) {
    if (!patch.differs_from_record) continue;
    names += (names.empty() ? "" : ", ") + patch.name;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return (count == 1 ? "The fit of " : "The fits of ") + names + (count == 1 ? " gives" : " give") +
         " other results than the recorded ones: the journal was made by another version or on another kind of "
         "machine. The new results stand.";
}

const MapEntry* find_map(const Document& document, const std::string& id) { return find(document.maps, id); }
const RobotEntry* find_robot(const Document& document, const std::string& id) {
  return find(document.robots, id);
}

bool is_taken(const Document& document, const std::string& id) {
  return find_scan(document, id) || find_region(document, id) || find_patch(document, id) ||
         find_map(document, id) || find_robot(document, id);
}

std::string free_id(const Document& document, const std::string& stem) {
  for (int number = 1;; ++number) {
    std::string id = stem + "-" + std::to_string(number);
    if (!is_taken(document, id)) return id;
  }
}

std::string frame_of(const ScanEntry& scan) { return is_identity(scan.scan->viewpoint) ? "sensor" : "world"; }

PatchSet patch_set(const Document& document, const std::string& journal) {
  PatchSet set;
  for (const ScanEntry& entry : document.scans) set.sources.push_back(source(entry));
  for (const PatchEntry& entry : document.patches) set.patches.push_back(record(document, entry, journal));
  return set;
}

}  // namespace patchlab
