#include "viewer/app/workbench.h"

#include <utility>

namespace patchlab::viewer {

namespace {

// A fit that takes longer is spoken of, and can be stopped.
constexpr std::chrono::milliseconds worth_a_word{400};

}  // namespace

ApplyOptions with_progress(const Progress& progress) {
  ApplyOptions options;
  options.progress = progress;
  return options;
}

Workbench::Workbench(WorkbenchOptions options, std::function<void()> wake)
    : options_(std::move(options)), worker_(std::move(wake)) {}

void Workbench::enqueue(std::function<void()> step) {
  steps_.push_back(std::move(step));
  start_next();
}

void Workbench::start_next() {
  while (!order_runs_ && !steps_.empty()) {
    const std::function<void()> step = std::move(steps_.front());
    steps_.pop_front();
    step();
  }
}

void Workbench::order(const std::string& name, Worker::Job job) {
  order_runs_ = true;
  worker_.order(name, [this, job = std::move(job)](const Progress& progress) -> Worker::Finish {
    return [this, finish = job(progress)] {
      order_runs_ = false;
      if (finish) finish();
      start_next();
    };
  });
}

void Workbench::in_background(std::function<Worker::Finish()> work) {
  worker_.order({}, [work = std::move(work)](const Progress&) { return work(); });
}

bool Workbench::deliver() { return worker_.deliver(); }

std::optional<Busy> Workbench::busy() const {
  if (const std::optional<Worker::Status> status = worker_.running_order()) {
    if (status->name.empty()) return std::nullopt;
    return Busy{status->name, status->fraction};
  }
  const std::optional<double> fitted = worker_.running_preview();
  const RegionEntry* region = find_region(session_.document(), region_);
  if (!fitted || !region || std::chrono::steady_clock::now() - fit_asked_ < worth_a_word) return std::nullopt;
  return Busy{"fitting " + std::to_string(region->points->size()) + " points", *fitted};
}

void Workbench::cancel_work() {
  if (worker_.running_order()) return worker_.cancel_order();
  const bool under_way = currency_ == Currency::fitting || currency_ == Currency::preview;
  if (!under_way || worker_.idle()) return;
  worker_.drop_previews();
  keep_when_ready_ = false;
  if (currency_ == Currency::preview) return;
  draft_ = Draft{session_.document(), std::nullopt, false};
  currency_ = Currency::failed;
  fit_message_ = "The fit was stopped; Enter fits again.";
  ++changes_;
}

void Workbench::report(const Error& error) {
  if (error.code != ErrorCode::cancelled) errors_.push_back(error);
}

bool Workbench::record(const Command& command, Document after) {
  if (const Result<void> done = session_.record(command, std::move(after)); !done) {
    report(done.error());
    return false;
  }
  after_change();
  return true;
}

void Workbench::run_now(const Command& command) {
  if (const Result<void> done = session_.run(command); !done) return report(done.error());
  after_change();
}

void Workbench::after_change() {
  drop_draft();
  if (!find_region(session_.document(), region_)) region_.clear();
}

void Workbench::drop_draft() {
  worker_.drop_previews();
  draft_.reset();
  keep_when_ready_ = false;
  currency_ = Currency::nothing;
  fit_message_.clear();
  ++changes_;
}

void Workbench::run(Command command) {
  enqueue([this, command = std::move(command)] { run_now(command); });
}

void Workbench::preview_joint(const SetJoint& set) {
  Command command = set;
  Result<Document> moved = apply(document(), command);
  if (!moved) return;
  if (!draft_) draft_ = Draft{};
  draft_->document = std::move(*moved);
  ++changes_;
}

void Workbench::undo() {
  enqueue([this] {
    if (!session_.can_undo()) return;
    run_now(Undo{});
    refit_open_region();
  });
}

void Workbench::redo() {
  enqueue([this] {
    if (session_.can_redo()) run_now(Redo{});
  });
}

void Workbench::go_to(std::size_t position) {
  enqueue([this, position] {
    while (session_.position() > position && session_.can_undo()) run_now(Undo{});
    while (session_.position() < position && session_.can_redo()) run_now(Redo{});
  });
}

std::vector<Error> Workbench::take_errors() { return std::exchange(errors_, {}); }
std::vector<std::string> Workbench::take_notices() { return std::exchange(notices_, {}); }
std::optional<std::string> Workbench::take_selection() { return std::exchange(selection_, std::nullopt); }

}  // namespace patchlab::viewer
