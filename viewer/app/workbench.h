// The document side of the viewer: the session, the worker, and the fit that follows the lasso. Knows no
// window, no GL and no ImGui; everything here is called on the thread of the user interface.
//
// What is on the screen is document(): the session's own, or a draft of it while a large scan is being read,
// a lasso is being drawn or a fit is not yet kept. A draft is made by the same apply() as a replay, so
// keeping it changes nothing that one sees.
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/project/session.h"
#include "viewer/panel/view_state.h"
#include "viewer/worker/worker.h"

namespace patchlab::viewer {

// A closed or still open contour, as the user drew it.
struct Stroke {
  SelectMode mode = SelectMode::set;
  std::vector<Eigen::Vector2d> polygon;  // viewport pixels
  ViewCamera camera;
  bool visible_only = false;                    // leaves out what other points hide
  std::optional<Eigen::Vector3d> surface_at{};  // m: in place of a contour, the smooth surface around a point
  std::string scan{};                           // id: of that point
};

// What to fit, as the tool bar says.
struct FitChoice {
  SurfaceRequest surface = SurfaceRequest::automatic;
  bool robust = true;
  BoundaryRequest boundary = BoundaryRequest::automatic;
};

struct WorkbenchOptions {
  std::filesystem::path journals;  // folder for the journals of scans that are opened
  bool keep_journals = true;       // false: nothing is written (a picture of a journal)
};

ApplyOptions with_progress(const Progress& progress);

class Workbench {
 public:
  // `wake` is called from the worker's thread when there is something for deliver().
  Workbench(WorkbenchOptions options, std::function<void()> wake);

  // In the background. A journal (.patchlab) replaces the session: one of the folder of journals is gone on
  // with, of one from elsewhere a copy there. A scan, a patch set or map (.json) or a robot (.urdf, with the
  // joint values and patches beside it) joins the session, with a new journal where there is none.
  void open(const std::filesystem::path& file, const ScanWishes& wishes = {});
  void run(Command command);  // quick ones: rename, delete, show, joints, places, merges
  // The document as it is with the joint there, until a command is run.
  void preview_joint(const SetJoint& set);
  void undo();
  void redo();
  void go_to(std::size_t position);  // of the history, by undo and redo
  void write_patches(const ExportRequest& request);
  void save_journal(const std::filesystem::path& file);

  // The lasso: previews while it is drawn, then the selection that is recorded.
  void preview(const Stroke& stroke);
  void select(const Stroke& stroke);
  void drop_preview();
  void reshape(Reshaping how);  // the region in focus
  // An empty specification: what suits the scan where nobody says. Refits all patches of the scan.
  void set_noise(const std::string& scan, const std::string& specification);

  // Which region a lasso changes and a fit is made of: the region of `id`, or of the patch `id`.
  void focus(const std::string& id);
  void choose(const FitChoice& choice);  // refits what is in focus
  void keep();                           // as soon as the fit of the present selection is there
  void discard();                        // the draft

  // Other work that takes a while; what it hands back runs in deliver().
  void in_background(std::function<Worker::Finish()> work);

  // Runs what the worker has finished; true where something changed.
  bool deliver();
  bool idle() const { return steps_.empty() && !order_runs_ && worker_.idle(); }
  void cancel_work();  // the order that runs, or else the fit
  std::optional<Busy> busy() const;

  const Document& document() const { return draft_ ? draft_->document : session_.document(); }
  // Its newest scan is a first look at a file that is still being read.
  bool shows_glimpse() const { return draft_ && draft_->glimpse; }
  const Session& session() const { return session_; }
  // The journal that the document comes from, also where it is only shown; empty where there is none.
  const std::filesystem::path& journal() const {
    return shown_journal_.empty() ? session_.journal() : shown_journal_;
  }
  const std::string& focused_region() const { return region_; }
  // Id of the patch that is fitted but not kept; empty where there is none.
  std::string draft_patch() const { return draft_ && draft_->fit ? draft_->fit->patch : std::string(); }
  Currency currency() const { return currency_; }
  const std::string& fit_message() const { return fit_message_; }
  double fit_milliseconds() const { return fit_milliseconds_; }
  // Of the points of a large region a preview takes one in so many; 1: all of them.
  std::size_t fitted_one_in() const { return fitted_one_in_; }
  bool fit_runs() const { return worker_.running_preview().has_value(); }
  std::uint64_t changes() const { return changes_; }  // grows whenever document() becomes another one
  // Sentences for the user since the last call.
  std::vector<Error> take_errors();
  std::vector<std::string> take_notices();
  // The id that a finished step asks to show: a new patch, region or scan; once.
  std::optional<std::string> take_selection();

 private:
  struct Draft {
    Document document;
    std::optional<Fit> fit;  // with its hash, ready to be recorded; none for a selection that has no fit
    bool keepable = false;   // the selection under it is recorded
    bool glimpse = false;    // a few points stand for the newest scan, which is still being read
  };
  // What the worker makes of a selection and a fit.
  struct Outcome {
    Document document;
    std::optional<Fit> fit;
    std::optional<Error> error;
    double milliseconds = 0.0;
    std::size_t one_in = 1;  // of the points
  };
  enum class Points { some, all };

  // With `some`, of a large region every so-many-th point only: a picture in a moment.
  Outcome attempt(Document document, const std::optional<Select>& select, Fit fit, Points points,
                  const ApplyOptions& how) const;
  std::optional<Patch> shown_fit(const Select& select) const;
  ApplyOptions applying(const Progress& progress) const;  // for the worker's thread too
  void change(const std::string& name, Command command);
  void follow(const Command& command, std::optional<Draft> shown);  // refits what a change was about
  // Why nothing can be selected so, as a sentence; nothing where it can.
  std::optional<std::string> refusal(const Stroke& stroke) const;
  Select select_command(const Stroke& stroke) const;
  Fit fit_command(const std::string& region) const;

  // Steps change the session one after the other: each starts when no order of an earlier one runs.
  void enqueue(std::function<void()> step);
  void start_next();
  void order(const std::string& name, Worker::Job job);

  Result<Session> begin_session(const std::filesystem::path& file, const Progress& progress) const;
  void open_journal(const std::filesystem::path& file);
  // `file` is the one that the user named.
  void open_with(Command command, const std::filesystem::path& file, const std::string& id);
  void open_scan(const OpenScan& command, const std::filesystem::path& file);
  void show_glimpse(const OpenScan& command, Scan scan);
  void record_opened(Command command, Document after, const std::filesystem::path& file,
                     const std::string& id);
  void tell_of_earlier_work(const std::filesystem::path& scan);
  Result<void> begin_journal(const std::filesystem::path& scan);
  bool record(const Command& command,
              Document after);  // false: it could not be written, and nothing has changed
  void run_now(const Command& command);
  void report(const Error& error);
  void refit();
  void fit(Points points);  // the region in focus; some of its points first, then all
  void refit_open_region();
  void accept(Outcome outcome, bool keepable);
  void drop_draft();
  void after_change();  // the session's document has become another one

  WorkbenchOptions options_;
  Session session_;
  std::filesystem::path shown_journal_;  // where the session keeps none
  std::shared_ptr<VisibilityCache> visibility_ = std::make_shared<VisibilityCache>();
  FitChoice choice_;
  std::string region_;  // in focus
  std::optional<Draft> draft_;
  bool keep_when_ready_ = false;
  Currency currency_ = Currency::nothing;
  std::string fit_message_;
  double fit_milliseconds_ = 0.0;
  std::size_t fitted_one_in_ = 1;
  std::chrono::steady_clock::time_point fit_asked_{};
  std::uint64_t changes_ = 0;
  std::vector<Error> errors_;
  std::vector<std::string> notices_;
  std::optional<std::string> selection_;
  std::deque<std::function<void()>> steps_;
  bool order_runs_ = false;
  Worker worker_;  // last: it stops before what its closures use goes away
};

}  // namespace patchlab::viewer
