// Everything a user can do to a document, as plain data. A command stores what was asked, never what came out
// of it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/io/scan_options.h"
#include "engine/project/colour.h"
#include "engine/project/document.h"
#include "engine/region/lasso.h"
#include "engine/region/visibility.h"

namespace patchlab {

struct OpenScan {
  std::string id;           // a new one
  std::string file;         // relative to the journal where it has one; "-" is standard input
  std::string sha256 = {};  // empty: not known yet, filled in when it is applied
  std::string noise = {};   // specification; empty: the scan's default
  bool points_in_sensor_frame = false;
  std::optional<Eigen::Vector3d> viewpoint = {};  // m: where the sensor stood, instead of what the file says
  LengthUnit unit = LengthUnit::m;                // of the lengths in the file
  std::optional<Intrinsics> intrinsics = {};      // of the camera of a depth image
  double depth_scale = 0.0;                       // raw units of a depth image a metre; 0: not said
};
// Patches of the scan are fitted again with the new model.
struct SetNoise {
  std::string scan, noise;
};
// Makes a region, or changes the one of that name: by a lasso, the smooth surface around a point, a label or
// ids of points, exactly one of them.
struct Select {
  std::string region, scan;
  SelectMode mode = SelectMode::set;
  std::vector<Eigen::Vector2d> polygon = {};  // viewport pixels; empty where label or indices is used
  ViewCamera camera = {};
  bool visible_only = false;                // of the lasso: only points that nothing hides from the camera
  std::optional<std::uint32_t> label = {};  // the points of one label instead
  std::optional<std::vector<std::uint32_t>> indices = {};
  std::optional<Eigen::Vector3d> flood = {};  // m, frame of the points: where the surface was pointed at
};
// Makes a region another one of the same scan: engine/region/grow.h says how.
enum class Reshaping { invert, grow, shrink, linked };
struct Reshape {
  std::string region;
  Reshaping how = Reshaping::grow;
  int steps = 1;  // rings, of grow and shrink
};
// Fits a patch to a region as it is now, or fits the patch of that name again. Later changes of the region
// leave it alone.
struct Fit {
  std::string patch, region;
  FitOptions options = {};
  std::string result_sha256 = {};  // hash of the result; checked on replay where present
};
// Files are relative to the journal where it has one. Their sha256 are empty where they are not known yet,
// and filled in when the command is applied.
struct OpenMap {
  std::string id;  // a new one
  std::string file, sha256 = {};
};
// Without joint values every joint starts at zero, or as near to it as its limits let it, known exactly.
struct OpenRobot {
  std::string id;    // a new one
  std::string file;  // URDF
  std::string sha256 = {};
  std::string joints = {}, joints_sha256 = {};    // may be empty
  std::string patches = {}, patches_sha256 = {};  // may be empty
};
struct SetJoint {
  std::string robot, joint;
  double value = 0.0;                // rad, or m of a sliding joint
  std::optional<double> sigma = {};  // stays as it is without it
};
// Hangs a frame in another, or hangs it there anew.
struct Place {
  std::string frame, in;
  UncertainPose pose;  // in_from_frame
};
// Brings the patches of `view` (another map, which is then gone, or a scan) into a map, a new one where there
// is none of that name: patches that both see are fused, but for the pairs refused; the others are added.
struct Merge {
  std::string map, view;
  double gate = 0.95;                                    // as AssociateOptions
  std::vector<std::array<std::string, 2>> refused = {};  // ids of patches: map, view
  std::string when = {};                                 // kept with the observations; may be empty
};
struct Rename {
  std::string target, name;  // an id
};
// Of a region and its patches, or by way of one of them; without a colour they get the viewer's own again.
struct SetColour {
  std::string target;  // an id
  std::optional<Colour> colour;
};
// With a scan go its regions and patches; a patch stays when its region goes.
struct Delete {
  std::string target;
};
struct Show {
  std::string target;
  bool visible = true;
};
struct Undo {};
struct Redo {};

using Command = std::variant<OpenScan, SetNoise, Select, Reshape, Fit, OpenMap, OpenRobot, SetJoint, Place,
                             Merge, Rename, SetColour, Delete, Show, Undo, Redo>;

// The files that a command names, to name them anew where the journal moves; empty ones are left out.
std::vector<std::string*> files_of(Command& command);

// One line of a journal, and back. unreadable error: `name` (where it stands), and the member that is wrong.
nlohmann::ordered_json to_json(const Command& command);
Result<Command> command_from_json(const nlohmann::json& json, const std::string& name = "journal");
// What the history list shows: "lasso mug side · 1,284 points".
std::string describe(const Command& command, const Document& after);

struct ApplyOptions {
  std::filesystem::path folder;             // relative scan files are looked for here
  std::optional<std::filesystem::path> on;  // replay on another scan file (--on): its bytes may differ
  Progress progress;
  std::shared_ptr<VisibilityCache> visibility =
      {};  // optional: keeps what a still camera sees between lassos
  // A fit starts at this patch and holds its type: for a picture while a lasso moves. Never for what is
  // recorded, whose bits a replay must find again.
  std::optional<Patch> fit_from = {};
};

// The document after a command other than Undo and Redo; fills in what the command left open (hashes).
// Errors: usage (an unknown id, a request that cannot be), unreadable, no_finite_fit; refused where a scan's
// bytes are not those that the command recorded.
Result<Document> apply(const Document& before, Command& command, const ApplyOptions& options = {});
// Hash of a fit's patch: its type and parameters and covariance, bit for bit.
std::string result_hash(const FitResult& fit);

}  // namespace patchlab
