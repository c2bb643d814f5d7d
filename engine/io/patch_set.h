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
  nlohmann::json unknown = nlohmann::json::object();  // as PatchRecord::unknown
};

// What a patch set keeps of a FitReport.
struct FitSummary {
  FitSummary() = default;
  FitSummary(const FitReport& report);

  FitMethod method = FitMethod::calibrated;
  bool robust = false;
  double containment = 1.0;
  std::size_t points = 0;    // used by the fit
  std::size_t outliers = 0;  // set aside by it
  double chi2 = 0.0;
  int dof = 0;
  double p_value = 0.0;
  int iterations = 0;
  double residual_rms = 0.0;  // m
  double coverage = 0.0;      // in [0, 1]
  bool accepted = false;
  std::vector<Finding> reasons;   // why it was not accepted; one without a name holds a plain sentence
  std::vector<Finding> warnings;  // written only where there are any
  std::vector<Candidate>
      candidates;  // the surfaces that were compared, best first; written where there were several
};

struct PatchRecord {
  std::string id;
  std::string name;
  std::string frame_id;
  std::string source;  // id of a PatchSource; empty for a designed patch
  Patch patch;
  std::optional<FitSummary> fit;
  nlohmann::json provenance = nullptr;
  // Members this version does not know, nested as they stood ({"fit": {"surprise": 1}}): kept and written
  // back.
  nlohmann::json unknown = nlohmann::json::object();
};

struct PatchSet {
  std::vector<PatchSource> sources;
  std::vector<PatchRecord> patches;
  nlohmann::json unknown = nlohmann::json::object();
};

// Numbers are written so that they read back to the same bits; NaN and infinity are never written (refused
// error).
Result<std::string> write_patch_set(const PatchSet& set);
// unreadable error: names the file, the patch and the member that is wrong; a higher major version is refused
// by name.
Result<PatchSet> read_patch_set(std::string_view text, const std::string& name);

}  // namespace patchlab
