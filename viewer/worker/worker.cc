#include "viewer/worker/worker.h"

#include <algorithm>
#include <utility>

namespace patchlab::viewer {

Worker::Worker(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  ready_.notify_one();
  thread_.join();
}

void Worker::order(std::string name, Job job) {
  {
    const std::lock_guard lock(mutex_);
    orders_.push_back({std::move(name), std::move(job), true, 0});
  }
  ready_.notify_one();
}

void Worker::preview(Job job) {
  {
    const std::lock_guard lock(mutex_);
    waiting_preview_ = Task{{}, std::move(job), false, epoch_};
  }
  ready_.notify_one();
}

void Worker::preview_now(Job job) {
  drop_previews();
  preview(std::move(job));
}

void Worker::drop_previews() {
  const std::lock_guard lock(mutex_);
  ++epoch_;
  waiting_preview_.reset();
}

void Worker::cancel_order() { cancel_order_ = true; }

bool Worker::is_stale(bool is_order, std::uint64_t epoch) const {
  return stop_ || (is_order ? cancel_order_.load() : epoch != epoch_);
}

bool Worker::deliver() {
  std::vector<Finished> ready;
  {
    const std::lock_guard lock(mutex_);
    ready.swap(finished_);
  }
  for (const Finished& done : ready)
    if (done.finish && (done.is_order || done.epoch == epoch_)) done.finish();
  return !ready.empty();
}

bool Worker::idle() const {
  const std::lock_guard lock(mutex_);
  return orders_.empty() && !waiting_preview_ && !running_ && finished_.empty();
}

std::optional<Worker::Status> Worker::running_order() const {
  const std::lock_guard lock(mutex_);
  return running_order_;
}

std::optional<double> Worker::running_preview() const {
  const std::lock_guard lock(mutex_);
  if (!running_preview_ || running_preview_->epoch != epoch_) return std::nullopt;
  return running_preview_->fraction;
}

Worker::Task Worker::take() {
  running_ = true;
  if (orders_.empty()) {
    running_preview_ = RunningPreview{0.0, epoch_};
    return *std::exchange(waiting_preview_, std::nullopt);
  }
  Task task = std::move(orders_.front());
  orders_.pop_front();
  running_order_ = Status{task.name, 0.0};
  cancel_order_ = false;
  return task;
}

Progress Worker::progress_of(const Task& task) {
  return [this, is_order = task.is_order, epoch = task.epoch](double fraction) {
    {
      const std::lock_guard lock(mutex_);
      double& known = is_order ? running_order_->fraction : running_preview_->fraction;
      known = std::max(known, fraction);
    }
    return !is_stale(is_order, epoch);
  };
}

void Worker::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    ready_.wait(lock, [this] { return stop_ || !orders_.empty() || waiting_preview_; });
    if (stop_) return;
    const Task task = take();
    lock.unlock();
    Finish finish = task.job(progress_of(task));
    lock.lock();
    running_ = false;
    running_order_.reset();
    running_preview_.reset();
    finished_.push_back({std::move(finish), task.is_order, task.epoch});
    wake_();
  }
}

}  // namespace patchlab::viewer
