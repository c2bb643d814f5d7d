// A document: scans, regions and patches with where each came from. A value, cheap to copy: points are
// shared.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/fit/fit_patch.h"
#include "engine/io/patch_set.h"
#include "engine/scan/scan.h"
#include "engine/sensor/noise_model.h"

namespace patchlab {

struct ScanEntry {
  std::string id;      // "scan-1"
  std::string name;    // file name, or what the user called it
  std::string sha256;  // of the file's bytes
  std::shared_ptr<const Scan> scan;
  NoiseModel noise;
  bool visible = true;
};

struct RegionEntry {
  std::string id;  // "region-1"
  std::string name;
  std::string scan;                                          // id
  std::shared_ptr<const std::vector<std::uint32_t>> points;  // ascending ids
  bool visible = true;
  std::size_t hidden_left_out = 0;  // points inside the last contour that others hide (visible only)
};

struct PatchEntry {
  std::string id;  // "patch-1"
  std::string name;
  std::string scan;    // id
  std::string region;  // id
  FitOptions options;
  std::shared_ptr<const FitResult> fit;
  // Ids of the scan's points behind fit->report.residuals, in that order.
  std::shared_ptr<const std::vector<std::uint32_t>> points;
  bool visible = true;
};

struct Document {
  std::vector<ScanEntry> scans;
  std::vector<RegionEntry> regions;
  std::vector<PatchEntry> patches;
};

const ScanEntry* find_scan(const Document& document, const std::string& id);
const RegionEntry* find_region(const Document& document, const std::string& id);
const PatchEntry* find_patch(const Document& document, const std::string& id);
// An id that is not taken yet: "patch-3".
std::string free_id(const Document& document, const std::string& stem);

// The document's patches as a patch set; `journal` names the file they came from in the provenance. A patch's
// frame_id is "sensor" where its scan was seen from the origin of its own frame along +z (no viewpoint, or
// the identity), so that the points are in the sensor's frame; "world" where the scan states another
// viewpoint.
PatchSet patch_set(const Document& document, const std::string& journal = {});

}  // namespace patchlab
