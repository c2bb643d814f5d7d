// What was acknowledged survives a kill at any instant. PATCHLAB_KILLS sets how many instants are tried.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "engine/project/session.h"
#include "tests/engine/project/scan_folder.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using Count = std::uint32_t;

class KillTest : public ScanFolder {
 protected:
  std::filesystem::path journal() const { return at("work.patchlab"); }

  // In a process of its own: goes on with the journal without end, and says how long its history is each time
  // that a command is acknowledged.
  [[noreturn]] void work(int acknowledge) const {
    Result<Session> session = Session::open(journal());
    if (!session) ::_exit(1);
    for (;;) {
      const auto done = static_cast<Count>(session->history().size());
      const Command next =
          done == 0 ? Command(open_boxes()) : Command(Rename{"scan-1", "name " + std::to_string(done)});
      if (!session->run(next)) ::_exit(2);
      const auto acknowledged = static_cast<Count>(session->history().size());
      if (::write(acknowledge, &acknowledged, sizeof acknowledged) != sizeof acknowledged) ::_exit(3);
    }
  }

  // The last count that a worker acknowledged which was killed so long after its first.
  Count killed_after(std::chrono::microseconds delay) const {
    int ends[2];
    if (::pipe(ends) != 0) return 0;
    const pid_t worker = ::fork();
    if (worker == 0) work(ends[1]);
    ::close(ends[1]);
    Count acknowledged = 0;
    const bool began = ::read(ends[0], &acknowledged, sizeof acknowledged) == sizeof acknowledged;
    EXPECT_TRUE(began) << "the journal cannot be gone on with";
    std::this_thread::sleep_for(delay);
    ::kill(worker, SIGKILL);
    int status = 0;
    ::waitpid(worker, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the worker gave up by itself: " << WEXITSTATUS(status);
    while (::read(ends[0], &acknowledged, sizeof acknowledged) == sizeof acknowledged) {
    }
    ::close(ends[0]);
    return acknowledged;
  }
};

TEST_F(KillTest, NothingAcknowledgedIsLostAndTheJournalGoesOn) {
  const char* wanted = std::getenv("PATCHLAB_KILLS");
  const int kills = wanted ? std::atoi(wanted) : 20;
  test::SeededRandom random;
  Count before = 0;
  for (int i = 0; i < kills; ++i) {
    const auto delay = std::chrono::microseconds(static_cast<int>(random.uniform(0.0, 20'000.0)));
    const Count acknowledged = killed_after(delay);
    ASSERT_GT(acknowledged, before) << "kill " << i;
    const Result<Session> again = Session::open(journal());
    ASSERT_TRUE(again) << again.error().message;
    // At most the command under way had been written without being acknowledged.
    ASSERT_GE(again->history().size(), acknowledged) << "kill " << i;
    ASSERT_LE(again->history().size(), acknowledged + 1) << "kill " << i;
    before = static_cast<Count>(again->history().size());
  }
  const Result<Document> replayed = replay(journal());
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_EQ(replayed->scans.at(0).name, "name " + std::to_string(before - 1));
}

}  // namespace
}  // namespace patchlab
