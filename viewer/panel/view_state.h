// What the panels show beside the document, and what they ask for. Panels read both, and change neither:
// whatever the user does in them comes back as Requests.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "engine/fit/fit_patch.h"
#include "engine/project/command.h"
#include "engine/project/placed.h"
#include "engine/region/lasso.h"
#include "viewer/camera/orbit_camera.h"
#include "viewer/panel/actions.h"
#include "viewer/panel/colours.h"
#include "viewer/panel/theme.h"

namespace patchlab::viewer {

enum class Tool { orbit, lasso, rectangle, surface, measure };
enum class PointColours { shading, photo, height, label, intensity, residual, noise };
// Which part of a patch's covariance is drawn: shape (intrinsic), pose (extrinsic) or both together.
enum class SigmaOf { both, shape, pose };

// Whether the patch on the screen is the fit of what is selected now. A preview is the fit of some of its
// points.
enum class Currency { nothing, fitting, preview, current, failed };

struct Layers {
  bool surface = true, ellipsoid = true, cone = true, band = true, axes = true, offsets = false,
       points = false, grid = false, names = false;
  bool operator==(const Layers&) const = default;
};

// What the picture must say of itself: text of the overlays, made with the scene.
struct SceneNotes {
  struct Label {
    Eigen::Vector2d pixel;  // in the view
    std::string text;
    Rgba colour;
  };
  std::vector<std::string> lines;               // "95 % ellipsoid of the centre, drawn 10 times larger"
  std::vector<Label> labels;                    // of axes
  std::optional<Eigen::Vector2d> height_sigma;  // least and largest on the surface, m: the colour bar
  bool residual_colours = false;
  struct PointBar {  // what the colours of the points mean
    const char* title;
    Eigen::Vector2d range;  // where they end, in the unit of the title
  };
  std::optional<PointBar> points;
  double metres_per_pixel = 0.0;  // at the pivot
};

// A distance that is being measured, or was: its ends in pixels of the view, what it came to, the sum in
// words.
struct MeasuredLine {
  std::vector<Eigen::Vector2d> ends;
  std::string text;
};

// Of the side panels, px at scale 1.
struct PanelWidths {
  float tree = 250.0f, inspector = 364.0f;
  bool operator==(const PanelWidths&) const = default;
};

struct Toast {
  std::string text;
  bool is_error = false;
  double until = 0.0;  // s, of ImGui's clock
};

struct Busy {
  std::string what;
  double fraction = 0.0;
};

// What is asked of the chosen patch, and the answers.
struct Questions {
  std::string other;                               // id of the patch that it is held against
  double limit = 20.0 * std::numbers::pi / 180.0;  // rad, of the tilt
  std::optional<Slope> slope;
  std::optional<Relation> relation;
  std::string message;  // why there is no relation
};

// What merging `view` into `map` would match, once the worker has found it.
struct Proposed {
  std::string map, view;  // ids; empty: nothing is proposed
  std::shared_ptr<const MergeProposal> matches;
  std::string message;  // why there are none
};

// Work of an earlier time that can be gone on with.
struct EarlierWork {
  std::filesystem::path journal;
  std::string scan;    // "bench"
  std::string remark;  // "12 steps, 2 Jan 14:02"
};

struct ViewState {
  ThemeChoice theme = ThemeChoice::dark;
  Tool tool = Tool::orbit;
  SelectMode mode = SelectMode::set;
  bool visible_only = true;  // a contour leaves out what other points hide
  SurfaceRequest surface = SurfaceRequest::automatic;
  BoundaryRequest boundary = BoundaryRequest::automatic;
  bool robust = true;
  bool perspective = true;
  PointColours colours = PointColours::shading;
  float point_size = 2.0f;  // px, times the scale
  ColourMap map = ColourMap::viridis;
  SigmaOf sigma_of = SigmaOf::both;
  bool side_panels = true;
  PanelWidths widths;
  Layers layers;

  std::string selected;  // id of the scan, region or patch that the inspector shows
  std::string draft;     // id of a patch that is fitted but not kept
  Currency currency = Currency::nothing;
  std::string fit_message;  // why there is no fit
  double fit_milliseconds = 0.0;
  std::size_t fitted_one_in = 1;  // of a preview: one point in so many
  bool fit_runs = false;          // a newer one is on its way

  bool drawing = false;  // a contour is open
  SelectMode contour_mode = SelectMode::set;
  std::vector<Eigen::Vector2d> contour;  // px of the view
  bool contour_closes = false;           // a click now would close it

  std::optional<MeasuredLine> measured;
  std::optional<DepthSlab> slab;  // all that is shown and selected; absent: everything
  Questions questions;
  Proposed proposed;

  std::vector<std::string> history;
  std::size_t position = 0;  // how much of the history stands
  bool can_undo = false, can_redo = false;
  std::string saved;                 // "saved 14:02:11"
  std::string journal;               // its path, with ~ for the home folder
  std::vector<EarlierWork> earlier;  // newest first
  std::optional<Busy> busy;
  std::vector<Toast> toasts;
  std::vector<Toast> messages;  // all toasts since the start
  SceneNotes notes;
};

// A picture of the window, or of the view alone: `times` larger than it is on the screen.
struct PictureRequest {
  std::filesystem::path file;
  int times = 1;
  bool view_alone = false, transparent = false;
};

// What a scan file does not say, and the user does.
struct ScanWishes {
  LengthUnit unit = LengthUnit::m;
  std::optional<Intrinsics> intrinsics = {};
  double depth_scale = 0.0;  // raw units a metre; 0: not said
};
struct OpenRequest {
  std::filesystem::path file;
  ScanWishes wishes = {};
  std::string instead_of = {};  // id of a scan that goes
};

struct ExportRequest {
  std::string format;
  std::filesystem::path file;
  std::string chosen = {};  // id of what is chosen: the patches of a map, or else those fitted to scans
};
struct ProposalRequest {
  std::string map, view;  // ids; empty: nothing any more
};

struct Requests {
  std::vector<Action> actions;
  std::vector<Command> commands;  // quick ones: rename, delete, show, joints, places, merges
  std::optional<std::string> select;
  std::optional<SurfaceRequest> surface;
  std::optional<SetNoise> noise;
  std::optional<std::size_t> history_position;
  std::optional<OpenRequest> open;
  std::optional<std::filesystem::path> save_journal;
  std::optional<ExportRequest> export_to;
  std::optional<PictureRequest> picture;
  std::optional<PanelWidths> widths;
  std::optional<DepthSlab> slab;
  std::optional<SetJoint> drag_joint;    // while a slider is held; the command follows when it is let go
  std::optional<std::string> ask_about;  // id of a patch to hold the chosen one against
  std::optional<double> tilt_limit;      // rad
  std::optional<ProposalRequest> propose;
  bool cancel_work = false;
};

}  // namespace patchlab::viewer
