// What was acknowledged survives a disk that fails and a loss of power at any instant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "engine/base/file.h"
#include "engine/project/session.h"
#include "tests/engine/project/scan_folder.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class DiskFaultsTest : public ScanFolder {
 protected:
  static Rename rename(std::size_t i) { return {"scan-1", "name " + std::to_string(i)}; }
  Session opened(const std::string& file = "work.patchlab") const {
    Result<Session> session = Session::open(at(file));
    EXPECT_TRUE(session) << (session ? "" : session.error().message);
    return session ? std::move(*session) : Session();
  }
  test::FaultyDisk disk_{at("")};
};

TEST_F(DiskFaultsTest, ALineIsWrittenThenSyncedThenShown) {
  Session session = opened();
  EXPECT_THAT(disk_.take_calls(), ElementsAre("sync folder", "cut", "sync", "write", "sync"));
  std::vector<std::string> order;
  disk_.before_sync = [&] {
    order = disk_.take_calls();
    order.emplace_back(session.document().scans.empty() ? "not shown" : "shown");
  };
  ASSERT_TRUE(session.run(open_boxes()));
  order.emplace_back("synced");
  order.emplace_back(session.document().scans.empty() ? "not shown" : "shown");
  EXPECT_THAT(order, ElementsAre("write", "not shown", "synced", "shown"));
  EXPECT_EQ(disk_.synced_bytes(), text("work.patchlab").size());
}

// The power goes just before each sync: what was written since the last one is there in part.
TEST_F(DiskFaultsTest, ALossOfPowerLosesNothingThatWasAcknowledged) {
  test::SeededRandom random;
  Session session = opened();
  struct Loss {
    std::string left;
    std::size_t acknowledged;
  };
  std::vector<Loss> losses;
  disk_.before_sync = [&] {
    const std::string bytes = text("work.patchlab");
    const std::size_t at_risk = bytes.size() - disk_.synced_bytes();
    losses.push_back(
        {bytes.substr(0, disk_.synced_bytes() + random.index(at_risk + 1)), session.history().size()});
  };
  ASSERT_TRUE(session.run(open_boxes()));
  for (std::size_t i = 0; i < 60; ++i) {
    ASSERT_TRUE(i % 5 == 4 ? session.run(Undo{}) : session.run(rename(i)));
  }
  disk_.before_sync = nullptr;
  ASSERT_EQ(losses.size(), 61U);
  for (const Loss& loss : losses) {
    write("after.patchlab", loss.left);
    const Session again = opened("after.patchlab");
    EXPECT_GE(again.history().size(), loss.acknowledged);
    EXPECT_LE(again.history().size(), loss.acknowledged + 1);
  }
}

class FaultAt : public DiskFaultsTest,
                public testing::WithParamInterface<std::tuple<std::size_t, std::size_t, int>> {};

// Any call may fail, once or until the disk recovers: the action is refused and told, and the next one that
// is acknowledged is there when the journal is opened again.
TEST_P(FaultAt, RefusesTheActionAndKeepsWhatWasAcknowledged) {
  const auto& [calls, failures, reason] = GetParam();
  std::size_t acknowledged = 0;
  {
    Session session = opened();
    ASSERT_TRUE(session.run(open_boxes()));
    disk_.fail(calls, reason, failures);
    std::size_t refused = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      const std::string before = session.document().scans.at(0).name;
      const Result<void> done = session.run(rename(i));
      if (!done) {
        ++refused;
        EXPECT_EQ(done.error().code, ErrorCode::unwritable);
        EXPECT_THAT(done.error().message, HasSubstr("the last action was not done"));
        EXPECT_EQ(session.document().scans.at(0).name, before);
      }
    }
    EXPECT_GE(refused, 1U);
    ASSERT_TRUE(session.run(rename(100))) << "the disk has recovered";
    acknowledged = session.history().size();
    EXPECT_EQ(acknowledged, 2 + 8 - refused);
  }
  const Session again = opened();
  EXPECT_EQ(again.history().size(), acknowledged);
  EXPECT_EQ(again.document().scans.at(0).name, "name 100");
}

INSTANTIATE_TEST_SUITE_P(Calls, FaultAt,
                         testing::Combine(testing::Range<std::size_t>(0, 4),
                                          testing::Values<std::size_t>(1, 2, 3, 4),
                                          testing::Values(EIO, ENOSPC)),
                         [](const auto& each) {
                           return std::to_string(std::get<0>(each.param)) + "_" +
                                  std::to_string(std::get<1>(each.param)) +
                                  (std::get<2>(each.param) == EIO ? "_EIO" : "_ENOSPC");
                         });

TEST_F(DiskFaultsTest, AnExportThatFailsLeavesTheOldFileAndNothingElse) {
  ASSERT_TRUE(write_file(at("set.json"), "old"));
  for (std::size_t calls = 0; calls < 2; ++calls) {
    const auto files = [this] {
      return std::distance(std::filesystem::directory_iterator(at("")),
                           std::filesystem::directory_iterator());
    };
    const auto before = files();
    disk_.fail(calls, EIO);
    const Result<void> written = write_file(at("set.json"), "new and longer");
    ASSERT_FALSE(written) << calls;
    EXPECT_THAT(written.error().message, HasSubstr("set.json"));
    EXPECT_EQ(text("set.json"), "old");
    EXPECT_EQ(files(), before);
  }
  ASSERT_TRUE(write_file(at("set.json"), "new"));
  EXPECT_EQ(text("set.json"), "new");
}

}  // namespace
}  // namespace patchlab
