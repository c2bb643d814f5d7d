#include "viewer/worker/worker.h"

#include <gtest/gtest.h>

#include <future>

namespace patchlab::viewer {
namespace {

// Jobs that start and end when the test says so; no test waits for a time.
class WorkerTest : public testing::Test {
 protected:
  struct Gate {
    std::promise<void> started, open;
  };

  Worker::Job note(const std::string& name) {
    return [this, name](const Progress&) { return [this, name] { done.push_back(name); }; };
  }
  // Runs until its gate is opened; hands back `name`.
  Worker::Job gated(Gate& gate, const std::string& name) {
    return [this, &gate, name](const Progress&) {
      gate.started.set_value();
      gate.open.get_future().wait();
      return [this, name] { done.push_back(name); };
    };
  }
  // Runs until it is told to stop.
  Worker::Job until_cancelled(Gate& gate, const std::string& name) {
    return [this, &gate, name](const Progress& progress) {
      gate.started.set_value();
      while (progress(0.5)) std::this_thread::yield();
      return [this, name] { done.push_back(name); };
    };
  }
  void finish() {
    while (!worker.idle()) {
      worker.deliver();
      std::this_thread::yield();
    }
  }

  std::vector<std::string> done;
  std::atomic<int> wakes = 0;
  Worker worker{[this] { ++wakes; }};
};

TEST_F(WorkerTest, OrdersAreAllDoneInOrder) {
  for (const char* name : {"a", "b", "c", "d"}) worker.order(name, note(name));
  finish();
  EXPECT_EQ(done, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(wakes, 4);
}

TEST_F(WorkerTest, OfPreviewsThatWaitOnlyTheNewestRuns) {
  Gate gate;
  worker.preview(gated(gate, "first"));
  gate.started.get_future().wait();
  for (const char* name : {"second", "third", "newest"}) worker.preview(note(name));
  gate.open.set_value();
  finish();
  EXPECT_EQ(done, (std::vector<std::string>{"first", "newest"}));
}

TEST_F(WorkerTest, ADroppedPreviewIsCancelledAndWhatItHandsBackIsNeverRun) {
  Gate gate;
  worker.preview(until_cancelled(gate, "stale"));
  gate.started.get_future().wait();
  worker.drop_previews();
  finish();
  EXPECT_TRUE(done.empty());
}

TEST_F(WorkerTest, APreviewThatIsDoneButNotDeliveredIsDroppedToo) {
  worker.preview(note("stale"));
  while (wakes == 0) std::this_thread::yield();
  worker.drop_previews();
  finish();
  EXPECT_TRUE(done.empty());
}

TEST_F(WorkerTest, PreviewNowCancelsTheOneThatRuns) {
  Gate gate;
  worker.preview(until_cancelled(gate, "stale"));
  gate.started.get_future().wait();
  worker.preview_now(note("newest"));
  finish();
  EXPECT_EQ(done, (std::vector<std::string>{"newest"}));
}

TEST_F(WorkerTest, OrdersGoBeforePreviews) {
  Gate gate;
  worker.order("gate", gated(gate, "gate"));
  gate.started.get_future().wait();
  worker.preview(note("preview"));
  worker.order("order", note("order"));
  gate.open.set_value();
  finish();
  EXPECT_EQ(done, (std::vector<std::string>{"gate", "order", "preview"}));
}

TEST_F(WorkerTest, ACancelledOrderStillHandsBack) {
  Gate gate;
  worker.order("load", until_cancelled(gate, "load"));
  gate.started.get_future().wait();
  ASSERT_TRUE(worker.running_order());
  EXPECT_EQ(worker.running_order()->name, "load");
  worker.cancel_order();
  finish();
  EXPECT_EQ(done, (std::vector<std::string>{"load"}));
}

TEST_F(WorkerTest, TheFractionOfAnOrderIsSeenWhileItRuns) {
  Gate gate;
  worker.order("load", until_cancelled(gate, "load"));
  gate.started.get_future().wait();
  while (worker.running_order()->fraction != 0.5) std::this_thread::yield();
  worker.cancel_order();
  finish();
  EXPECT_FALSE(worker.running_order());
}

TEST_F(WorkerTest, NothingIsRunOnTheUserInterfaceBeforeDeliver) {
  worker.order("a", note("a"));
  while (wakes == 0) std::this_thread::yield();
  EXPECT_TRUE(done.empty());
  EXPECT_FALSE(worker.idle());
  EXPECT_TRUE(worker.deliver());
  EXPECT_EQ(done.size(), 1u);
  EXPECT_FALSE(worker.deliver());
}

TEST(WorkerEnd, AWorkerThatGoesAwayCancelsWhatRuns) {
  std::promise<void> started;
  bool cancelled = false;
  {
    Worker worker([] {});
    worker.order("endless", [&](const Progress& progress) -> Worker::Finish {
      started.set_value();
      while (progress(0)) std::this_thread::yield();
      cancelled = true;
      return {};
    });
    started.get_future().wait();
  }
  EXPECT_TRUE(cancelled);
}

}  // namespace
}  // namespace patchlab::viewer
