// The one thread of the viewer that works: loads, selections, fits. The user interface never waits for it.
//
// A job gets a snapshot in (whatever it captured), runs on the worker's thread, and hands back a closure that
// deliver() runs on the thread of the user interface. Two kinds:
//   order     what the user did (open a file, close a lasso): every one is done, in order
//   preview   what a live picture wants: the newest wins. A newer one replaces one that waits; one that runs
//   is let
//             finish, so that the picture moves on while the lasso does, unless preview_now() or
//             drop_previews() cancels it. What a dropped preview hands back is never run.
// Orders go before previews. A job is cancelled by its Progress.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/progress.h"

namespace patchlab::viewer {

class Worker {
 public:
  using Finish = std::function<void()>;
  using Job = std::function<Finish(const Progress&)>;

  // `wake` is called from the worker's thread when something is ready for deliver(); it must not call the
  // worker.
  explicit Worker(std::function<void()> wake);
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker();  // cancels what runs, drops what waits

  void order(std::string name, Job job);
  void preview(Job job);
  void preview_now(Job job);
  void drop_previews();
  void cancel_order();  // the one that runs

  // Runs what has been handed back; true where there was something.
  bool deliver();
  // Nothing waits, nothing runs, nothing is to be delivered.
  bool idle() const;
  // Name and fraction of the order that runs.
  struct Status {
    std::string name;
    double fraction = 0.0;
  };
  std::optional<Status> running_order() const;
  // Fraction of the preview that runs; nothing where none does that anybody still wants.
  std::optional<double> running_preview() const;

 private:
  struct Task {
    std::string name;
    Job job;
    bool is_order = false;
    std::uint64_t epoch = 0;  // of previews: dropped when it is not the worker's any more
  };
  struct Finished {
    Finish finish;
    bool is_order = false;
    std::uint64_t epoch = 0;
  };
  void run();
  Task take();  // the next one; the mutex is held
  Progress progress_of(const Task& task);
  bool is_stale(bool is_order, std::uint64_t epoch) const;

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Task> orders_;
  std::optional<Task> waiting_preview_;
  std::vector<Finished> finished_;
  std::optional<Status> running_order_;
  struct RunningPreview {
    double fraction = 0.0;
    std::uint64_t epoch = 0;
  };
  std::optional<RunningPreview> running_preview_;
  bool running_ = false;
  std::atomic<bool> cancel_order_ = false;
  std::atomic<std::uint64_t> epoch_ = 0;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace patchlab::viewer
