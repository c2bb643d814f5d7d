// The panels, one a file. Each reads the document and the view state, draws itself, and adds to the requests.
#pragma once

#include <array>

#include "engine/project/document.h"
#include "viewer/panel/choices.h"
#include "viewer/panel/file_dialog.h"
#include "viewer/panel/gui.h"
#include "viewer/panel/layout.h"
#include "viewer/panel/scan_form.h"
#include "viewer/panel/view_state.h"

namespace patchlab::viewer {

// What panels remember between frames for themselves.
struct PanelMemory {
  std::string renaming;  // id whose name is being typed
  std::string new_name;
  FileDialog files;
  bool help = false;
  std::string help_filter;
  bool palette = false, messages = false;  // open
  std::string palette_filter;
  std::size_t palette_cursor = 0;
  ScanForm scan_form;
  std::vector<std::array<std::string, 2>> refused;  // of the proposed matches: ids in the map, in the view
  std::string held_joint;                           // whose slider is held
  bool choose_noise = false;                        // opens the list of noise models
  std::string noise_specification;
};

struct PanelInput {
  const Gui& gui;
  const Document& document;
  const ViewState& state;
  const Layout& layout;
};

// All of them, in order.
void draw_panels(const PanelInput& in, PanelMemory& memory, Requests& out);

void draw_menu_bar(const PanelInput& in, Requests& out);
void draw_tool_bar(const PanelInput& in, Requests& out);
void draw_tree(const PanelInput& in, PanelMemory& memory, Requests& out);
void draw_inspector(const PanelInput& in, PanelMemory& memory, Requests& out);
void draw_status_bar(const PanelInput& in, Requests& out);
void draw_overlay(const PanelInput& in);  // over the scene: notes, pill, scale bar, colour bar, contour
void draw_help_sheet(const PanelInput& in, PanelMemory& memory);
void draw_toasts(const PanelInput& in);
void draw_splitters(const PanelInput& in, Requests& out);
void draw_slab(const PanelInput& in, Requests& out);  // how thick the depth slab is
void draw_palette(const PanelInput& in, PanelMemory& memory, Requests& out);
void draw_messages(const PanelInput& in, PanelMemory& memory);

// Parts of the overlay.
void draw_colour_bars(const PanelInput& in, ImDrawList& draw);
void draw_measured_line(const PanelInput& in, ImDrawList& draw);

// Parts of the inspector.
void draw_verdict(const Gui& gui, const FitReport& report);
void draw_noise(const Gui& gui, const ScanEntry& scan, PanelMemory& memory, Requests& out);
void draw_parameters(const Gui& gui, const Patch& patch);
void draw_correlation(const Gui& gui, const Patch& patch);
void draw_residuals(const Gui& gui, const FitReport& report);
void draw_candidates(const Gui& gui, const FitReport& report, SurfaceType shown, Requests& out);

void draw_title(const Gui& gui, const std::string& title, const std::string& kind);
void draw_robot(const PanelInput& in, const RobotEntry& robot, PanelMemory& memory, Requests& out);
void draw_map(const PanelInput& in, const MapEntry& map, PanelMemory& memory, Requests& out);
void draw_placed_patch(const PanelInput& in, const PlacedPatch& patch, Requests& out);
void draw_place(const PanelInput& in, const std::string& frame, Requests& out);
// What can be merged into a new or known map: nothing where there is nothing.
void draw_merging(const PanelInput& in, const std::string& map, PanelMemory& memory, Requests& out);
void draw_questions(const PanelInput& in, const std::string& patch, Requests& out);

// Words.
// What a fit is blamed for and what it is warned of, each once: reasons first. Remarks about the frame that
// the parameters are given in stand beside the correlations.
std::vector<std::string> sentences_of(const FitReport& report);
std::string choice_words(const std::vector<Candidate>& candidates);  // why the chosen surface was chosen
std::string surface_words(SurfaceType surface);                      // "elliptic paraboloid"
std::string short_surface_words(SurfaceType surface);                // "ell. paraboloid"
std::string boundary_words(BoundaryType boundary);
std::string kind_words(const PatchTypeRow& type);  // "ell. paraboloid · ellipse"
std::string noise_words(const NoiseModel& model);  // "kinect1 (assumed)"

}  // namespace patchlab::viewer
