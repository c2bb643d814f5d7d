// Exports of a patch set: a table of formats, and what a user may ask of one.
//
// Every export is whole or fails: an error names the patch and the reason. What a format cannot hold of any
// patch is said in its row of the table; what was left out of this set, in the notices of the result.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/fit/observation.h"
#include "engine/io/patch_set.h"

namespace patchlab {

struct ExportOptions {
  std::vector<std::string> patches = {};  // ids; empty: all
  std::optional<double> thickness = {};   // m: meshes as closed solids this thick; of worlds, 5 mm without it
  std::vector<std::string> covariances = {};  // further covariances of the pose (engine/io/pose_covariance.h)
  double inset_sigmas = 2.0;                  // footholds: standard deviations of the outline kept away from
  double foot_radius = 0.0;                   // footholds: m, kept away from the outline besides
  Vector3d up = Vector3d::UnitZ();            // footholds: against gravity, in the frame of the patches
  double tilt_limit = 0.5235987755982988;     // footholds: rad, whose probability to be exceeded is written
  // By patch id, in its frame: the points that it was fitted to, for a bag of ROS 1. A patch set keeps none;
  // of a patch that has none here, points of its surface are written.
  std::map<std::string, Observations> measured = {};
};

struct ExportedFile {
  std::string name;  // within the folder of the export; empty where the format is one file
  std::string bytes;
};

struct Exported {
  std::vector<ExportedFile> files;
  std::vector<std::string> notices;  // whole sentences: what was left out, of which patch, and why
};

struct ExportFormat {
  std::string_view name;       // "patch_set", "ply"
  std::string_view extension;  // ".json"; empty: a folder of several files
  std::string_view description;
  std::string_view covariance;  // what is written of it, and by which convention
  Result<Exported> (*write)(const PatchSet& set, const ExportOptions& options);

  bool is_folder() const { return extension.empty(); }
};

std::span<const ExportFormat> export_formats();
// usage error that lists the formats for an unknown name.
Result<const ExportFormat*> export_format(std::string_view name);

// The patches asked for, each checked, in the format. usage error for an id that the set does not hold or an
// option that is out of range; refused error where the format cannot express a patch, by its id.
Result<Exported> export_patches(const ExportFormat& format, const PatchSet& set,
                                const ExportOptions& options = {});

// What an export would write, for who decides: nothing is written.
struct ExportPreview {
  std::vector<std::string> patches;  // ids of those in it
  std::vector<std::string> lines;    // files and sizes, the covariance's convention, what is left out
  std::string refusal;               // why it would fail; empty where it would not
};
ExportPreview preview_export(const ExportFormat& format, const PatchSet& set,
                             const ExportOptions& options = {});

// Puts it in place whole or not at all: a file, or a folder that must not be there yet (or be empty). "-" is
// standard output, for one file only.
Result<void> write_exported(const Exported& exported, const std::filesystem::path& place);

}  // namespace patchlab
