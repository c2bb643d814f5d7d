// The program: owns everything, and makes one frame after the other. No statics, no globals.
//
//   deliver what the worker has made -> input -> scene -> panels -> what the panels ask for
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/app/settings.h"
#include "viewer/app/stage.h"
#include "viewer/app/workbench.h"
#include "viewer/panel/panels.h"
#include "viewer/platform/platform.h"
#include "viewer/render/renderer.h"
#include "viewer/tool/lasso_tool.h"
#include "viewer/tool/measure.h"
#include "viewer/tool/navigation.h"

namespace patchlab::viewer {

struct AppOptions {
  Settings settings;
  std::filesystem::path journals;  // folder for the journals of opened scans
  bool keep_journals = true;
  bool asks = true;  // what a file does not say; false where nobody would answer
};

// A picture of the program as it stands.
struct PictureOptions {
  int width = 0, height = 0;  // px
  float scale = 0.0f;         // of the interface; 0: as on the screen
  bool view_alone = false;    // without the panels
  bool transparent = false;   // of the view alone: without its ground
};

class App {
 public:
  // `platform` outlives the app.
  App(Platform& platform, Renderer renderer, AppOptions options);

  void open(const std::filesystem::path& file, const ScanWishes& wishes = {});
  void frame();
  Image picture(const PictureOptions& options);
  // Nothing moves and nothing runs in the background: the next frame would be the same.
  bool settled() const;
  bool wants_to_close() const { return close_; }
  // How long the next frame can wait for input, s.
  double patience() const;

  void clear_notices() { state_.toasts.clear(); }
  // As the user has made them by now.
  Settings settings() const;

  Workbench& workbench() { return workbench_; }
  const ViewState& state() const { return state_; }
  const OrbitCamera& camera() const { return stage_.camera; }
  // Of the last frame: what replayed logs and tests click on.
  const WidgetMap& widgets() const { return widgets_; }
  const Layout& layout() const { return layout_; }
  // Every error that was shown to the user, oldest first.
  const std::vector<Error>& errors() const { return errors_; }

 private:
  // app.cc
  void collect();  // what the workbench has to say, into the view state
  void show_new_document();
  void set_up_camera();
  void make_shades();
  void make_sigmas();
  bool ask_what_is_missing(const Error& error);  // false: nothing to ask
  void ask_for_unit();
  void show_measured();
  void find_earlier_work();
  // questions.cc
  void answer_questions();
  void propose();
  void draw();
  void toast(const std::string& text, bool is_error);
  // picture.cc
  Image shot(std::optional<Rgba> ground);
  void save_picture(const PictureRequest& request);

  // frame_budget.cc
  std::size_t points_one_in();
  void draw_scene(const ViewCamera& camera);

  double aspect() const;
  ViewCamera view() const;

  // input.cc
  void handle_pointer();
  void press(Button button);
  void release(Button button);
  void double_click();
  void click();
  void select_surface();
  void measure();
  struct Pointed {
    std::string scan;
    std::uint32_t id;
    Eigen::Vector3d point;  // m
  };
  std::optional<Pointed> point_under_pointer() const;
  void lasso(LassoTool::Outcome outcome);
  void handle_keys();
  LassoView lasso_view() const;
  Eigen::Vector2d pointer() const;  // px of the view

  // view_actions.cc
  bool act_on_view(Action action);
  bool turn_view(Action action);
  void view_of_sensor();
  void scale_interface(float scale);

  // requests.cc
  void answer(const Requests& requests);
  void answer_about_maps(const Requests& requests);
  void act(Action action);
  bool choose(Action action);
  bool act_on_contour_and_fit(Action action);
  bool open_sheet(Action action);
  void act_on_document(Action action);
  void cancel();
  void toggle_slab();
  void keep();
  void remove_selected();
  void hide_selected();
  void show_all();
  void rename_selected();
  void choose_surface(SurfaceRequest surface);
  void select(const std::string& id);

  Platform& platform_;
  Renderer renderer_;
  AppOptions options_;
  ViewState state_;
  PanelMemory memory_;
  Layout layout_;
  WidgetMap widgets_;
  Stage stage_;
  LassoTool lasso_;
  Navigation navigation_;
  std::optional<Eigen::Vector2d>
      pressed_;  // px, where the left button went down to navigate: a click if it stays there
  struct FrameBudget {
    ViewCamera drawn;        // the camera of the last frame
    double moved_at = -1e9;  // s, of ImGui's clock
    double per_point = 0.0;  // s, as the last frame took
    std::size_t one_in = 1;  // of the points, in the last frame
  };
  FrameBudget budget_;
  std::vector<MeasuredPoint> measured_;
  std::optional<PictureOptions> picture_;  // while one is taken: no input, no requests
  std::optional<Rgba> ground_;             // behind the scene, in place of the theme's
  std::filesystem::path asked_for_;        // opened last: what is missing is asked for it
  std::vector<Error> errors_;
  std::optional<std::filesystem::path> journal_to_show_;  // its camera is taken when it is open
  std::string styled_for_;                                // theme and scale that ImGui's style was made for
  std::shared_ptr<const Scan> camera_of_;                 // what the camera was last set up for
  std::optional<OrbitCamera> glimpsed_from_;              // as it was set up for a first look at a scan
  bool looks_at_all_ = false;                             // at a document without a scan
  struct Answered {
    std::uint64_t changes = 0;
    std::string patch, other;
    double limit = 0.0;
    bool operator==(const Answered&) const = default;
  };
  Answered answered_;
  std::uint64_t proposed_at_ = 0;  // of the document's changes
  std::uint64_t seen_changes_ = 0;
  std::optional<float> wanted_scale_;  // of the interface, from the next frame on
  float chosen_scale_ = 0.0f;          // by the user; 0: none
  bool close_ = false;
  Workbench workbench_;  // last: its worker stops first
};

}  // namespace patchlab::viewer
