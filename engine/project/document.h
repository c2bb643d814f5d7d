// A document: scans, regions, patches, maps and robots with where each came from. A value, cheap to copy:
// points are shared.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/fit/fit_patch.h"
#include "engine/io/patch_set.h"
#include "engine/map/patch_map.h"
#include "engine/map/robot.h"
#include "engine/project/colour.h"
#include "engine/scan/scan.h"
#include "engine/sensor/noise_model.h"

namespace patchlab {

struct MeshData;

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
  std::optional<Colour> colour{};   // chosen by hand, for its patches too
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
  std::optional<Colour> colour{};
  bool differs_from_record = false;  // a replay's fit that gave another result than its journal recorded
};

// A patch set or map in a frame of its own.
struct MapEntry {
  std::string id;  // "map-1"
  std::string name;
  std::shared_ptr<const PatchMap> map;
  std::shared_ptr<const PatchSet> set;  // the same as it is written: with sources and what else is known
  bool visible = true;
};

// What the files of a robot say.
struct RobotModel {
  Robot robot;
  std::vector<RobotPatch> patches;  // in the frames of their links
  LinkTolerance tolerance;
  std::vector<std::shared_ptr<const MeshData>> meshes;  // one a shape of the robot; null of other shapes
  std::vector<std::string> notices;                     // meshes that cannot be drawn
};
struct RobotEntry {
  std::string id;  // "robot-1"
  std::string name;
  std::string frame;  // that its base is fixed in
  std::shared_ptr<const RobotModel> model;
  JointValues joints;
  bool visible = true;
};

// A frame hung in another.
struct FrameEntry {
  std::string name, in;
  UncertainPose pose;  // in_from_name
};

struct Document {
  std::vector<ScanEntry> scans;
  std::vector<RegionEntry> regions;
  std::vector<PatchEntry> patches;
  std::vector<MapEntry> maps;
  std::vector<RobotEntry> robots;
  std::vector<FrameEntry> frames;
};

const ScanEntry* find_scan(const Document& document, const std::string& id);
const RegionEntry* find_region(const Document& document, const std::string& id);
const PatchEntry* find_patch(const Document& document, const std::string& id);
// One sentence that names the patches that differ from their record; nothing where none does.
std::optional<std::string> notice_of_other_results(const Document& document);
const MapEntry* find_map(const Document& document, const std::string& id);
const RobotEntry* find_robot(const Document& document, const std::string& id);
bool is_taken(const Document& document, const std::string& id);
// An id that is not taken yet: "patch-3".
std::string free_id(const Document& document, const std::string& stem);

// The frame of a scan's points: "sensor" where it was seen from the origin of its own frame along +z (no
// viewpoint, or the identity), so that the points are in the sensor's frame; "world" where the scan states
// another viewpoint.
std::string frame_of(const ScanEntry& scan);

// The patches fitted to scans as a patch set; `journal` names the file they came from in the provenance.
PatchSet patch_set(const Document& document, const std::string& journal = {});

}  // namespace patchlab
