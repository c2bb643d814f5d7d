// The patch set (JSON): the exact, documented exchange format. Schema: assets/schema/patch_set.schema.json.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/fit/fit_patch.h"
#include "engine/patch/patch.h"
#include "engine/scan/scan.h"

namespace patchlab {

struct PatchSource {
  std::string id, file, sha256, noise;
  bool noise_assumed = false;
  Viewpoint viewpoint;
};

struct PatchRecord {
  std::string id;
  std::string name;
  std::string frame_id;
  std::string source;                       // id of a PatchSource; empty for a designed patch
  Patch patch;
  std::optional<FitReport> fit;             // what is kept of it: the members section 5 of DESIGN.md lists
  nlohmann::json provenance = nullptr;
  nlohmann::json unknown = nlohmann::json::object();  // fields this version does not know, kept and written back
};

struct PatchSet {
  std::vector<PatchSource> sources;
  std::vector<PatchRecord> patches;
  nlohmann::json unknown = nlohmann::json::object();
};

// Numbers are written so that they read back to the same bits; NaN and infinity are never written (refused error).
Result<std::string> write_patch_set(const PatchSet& set);
// unreadable error: names the file, the patch and the member that is wrong; a higher major version is refused by name.
Result<PatchSet> read_patch_set(std::string_view text, const std::string& name);

}  // namespace patchlab
