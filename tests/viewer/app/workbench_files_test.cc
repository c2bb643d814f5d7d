#include "tests/viewer/app/workbench_fixture.h"

#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "tests/support/file_size_limit.h"
#include "viewer/app/journal_file.h"

namespace patchlab::viewer {
namespace {

TEST_F(WorkbenchTest, AScanThatIsOpenedBeginsAJournal) {
  ASSERT_EQ(kept().scans.size(), 1u);
  EXPECT_EQ(bench_.session().journal().parent_path(), folder_.path() / "state");
  EXPECT_EQ(bench_.session().history().size(), 1u);
  EXPECT_EQ(bench_.take_selection(), "scan-1");
}

TEST_F(WorkbenchTest, AJournalThatIsOpenInAnotherProgramIsToldAndLeftAlone) {
  Workbench other{{folder_.path() / "state", true}, [] {}};
  other.open(bench_.session().journal());
  while (!other.idle()) {
    other.deliver();
    std::this_thread::yield();
  }
  const std::vector<Error> errors = other.take_errors();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("is open in another patchlab"), std::string::npos) << errors[0].message;
  EXPECT_TRUE(other.document().scans.empty());
}

TEST_F(WorkbenchTest, AFullDiskIsToldAtOnceAndNothingIsShownAsDone) {
  bench_.select(square(13));
  finish();
  const std::vector<std::uint32_t> before = *kept().regions.at(0).points;
  {
    const test::FileSizeLimit limit(std::filesystem::file_size(bench_.session().journal()) + 10);
    bench_.select(square(8));
    finish();
    bench_.keep();
    finish();
  }
  ASSERT_EQ(errors_.size(), 2u);
  EXPECT_NE(errors_[0].find("the last action was not done"), std::string::npos) << errors_[0];
  EXPECT_EQ(*kept().regions.at(0).points, before);
  EXPECT_TRUE(kept().patches.empty());
  EXPECT_EQ(bench_.currency(), Currency::current);
  bench_.keep();
  finish();
  EXPECT_EQ(replay(bench_.session().journal())->patches.size(), 1u) << "there is room again";
}

TEST_F(WorkbenchTest, AFileThatCannotBeReadIsToldAndTheSessionStays) {
  bench_.open(folder_.path() / "missing.pcd");
  finish();
  ASSERT_EQ(errors_.size(), 1u);
  EXPECT_NE(errors_[0].find("missing.pcd"), std::string::npos);
  EXPECT_EQ(kept().scans.size(), 1u);
}

// A file that takes a while: a wall as a table, with `end` after it.
std::filesystem::path large_table(const std::filesystem::path& folder, const std::string& end) {
  constexpr int side = 1000;
  std::string rows = "x,y,z\n";
  for (int i = 0; i < side * side; ++i) {
    rows += "0." + std::to_string(side + i % side) + ",0." + std::to_string(side + i / side) + ",1.125\n";
  }
  const std::filesystem::path file = folder / "large.csv";
  EXPECT_TRUE(write_file(file, rows + end));
  return file;
}

TEST_F(WorkbenchTest, ALargeScanIsSeenBeforeItIsRead) {
  bench_.open(large_table(folder_.path(), {}));
  while (bench_.document().scans.size() < 2) {
    bench_.deliver();
    std::this_thread::yield();
  }
  EXPECT_TRUE(bench_.shows_glimpse());
  EXPECT_EQ(kept().scans.size(), 1u);
  EXPECT_EQ(bench_.document().scans[1].id, "scan-2");
  EXPECT_LT(bench_.document().scans[1].scan->size(), 200'000u);
  finish();
  EXPECT_FALSE(bench_.shows_glimpse());
  ASSERT_EQ(kept().scans.size(), 2u);
  EXPECT_EQ(kept().scans[1].scan->size(), 1'000'000u);
  EXPECT_EQ(kept().scans[1].name, "large.csv");
}

TEST_F(WorkbenchTest, AFirstLookIsTakenBackWhereTheFileTurnsOutToBeDamaged) {
  bench_.open(large_table(folder_.path(), "0.5,nonsense,1\n"));
  bool seen = false;
  while (!bench_.idle()) {
    bench_.deliver();
    seen = seen || bench_.shows_glimpse();
    std::this_thread::yield();
  }
  finish();
  EXPECT_TRUE(seen);
  ASSERT_EQ(errors_.size(), 1u);
  EXPECT_NE(errors_[0].find("nonsense"), std::string::npos) << errors_[0];
  EXPECT_EQ(bench_.document().scans.size(), 1u);
}

TEST_F(WorkbenchTest, ThePatchesAreExportedAndTheJournalIsCopiedWithItsScanStillFound) {
  bench_.select(square(13));
  bench_.keep();
  finish();
  bench_.write_patches({"patch_set", folder_.path() / "set.json"});
  std::filesystem::create_directories(folder_.path() / "a" / "b");
  bench_.save_journal(folder_.path() / "a" / "b" / "copy.patchlab");
  finish();
  EXPECT_TRUE(errors_.empty()) << errors_[0];
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "set.json"));
  const Result<Document> replayed = replay(folder_.path() / "a" / "b" / "copy.patchlab");
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_EQ(replayed->patches.size(), 1u);
}

TEST_F(WorkbenchTest, AJournalOfTheFolderIsGoneOnWithWhereItEnded) {
  bench_.select(square(13));
  bench_.keep();
  finish();
  const std::filesystem::path journal = bench_.session().journal();
  const std::filesystem::path copy = folder_.path() / "state" / "copy.patchlab";
  ASSERT_TRUE(copy_journal(journal, copy));
  bench_.open(copy);
  finish();
  EXPECT_TRUE(errors_.empty()) << errors_[0];
  EXPECT_EQ(bench_.session().journal(), copy);
  EXPECT_EQ(kept().patches.size(), 1u);
  EXPECT_EQ(bench_.session().history().size(), 3u);
  EXPECT_EQ(bench_.take_selection(), "patch-1");
}

TEST_F(WorkbenchTest, AJournalFromElsewhereStaysAsItIsAndACopyIsGoneOnWith) {
  bench_.select(square(13));
  bench_.keep();
  finish();
  const std::filesystem::path other = folder_.path() / "other.patchlab";
  ASSERT_TRUE(copy_journal(bench_.session().journal(), other));
  const Bytes before = *read_file(other);
  bench_.take_notices();
  bench_.open(other);
  finish();
  ASSERT_TRUE(errors_.empty()) << errors_[0];
  const std::filesystem::path journal = bench_.session().journal();
  EXPECT_EQ(journal.parent_path(), folder_.path() / "state");
  const std::vector<std::string> notices = bench_.take_notices();
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_NE(notices[0].find(journal.string()), std::string::npos) << notices[0];

  bench_.run(Rename{"patch-1", "ball"});
  EXPECT_EQ(*read_file(other), before);
  const Result<Document> replayed = replay(journal);
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_EQ(replayed->patches.at(0).name, "ball");
}

TEST_F(WorkbenchTest, AJournalThatCannotBeReplayedLeavesNoCopy) {
  const std::filesystem::path other = folder_.path() / "other.patchlab";
  ASSERT_TRUE(write_file(other, journal_header() + "\n{\"do\": \"delete\", \"target\": \"scan-9\"}\n"));
  const auto journals = [this] {
    return std::distance(std::filesystem::directory_iterator(folder_.path() / "state"), {});
  };
  const auto before = journals();
  bench_.open(other);
  finish();
  EXPECT_EQ(errors_.size(), 1u);
  EXPECT_EQ(journals(), before);
}

TEST(WorkbenchWithoutJournals, LeavesTheJournalItShowsAsItIs) {
  const TestFolder folder;
  std::filesystem::path journal;
  {
    Workbench bench({folder.path(), true}, [] {});
    bench.open(folder.ball());
    while (!bench.idle()) bench.deliver();
    journal = bench.session().journal();
  }
  const Bytes before = *read_file(journal);
  Workbench bench({folder.path(), false}, [] {});
  bench.open(journal);
  while (!bench.idle()) bench.deliver();
  bench.run(Rename{"scan-1", "another"});
  EXPECT_EQ(bench.document().scans.at(0).name, "another");
  EXPECT_EQ(*read_file(journal), before);
}

}  // namespace
}  // namespace patchlab::viewer
