#include "engine/project/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "engine/base/random.h"
#include "tests/engine/project/scan_folder.h"
#include "tests/support/file_size_limit.h"

namespace patchlab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SessionTest : public ScanFolder {
 protected:
  Session opened(const std::string& file = "work.patchlab") const {
    Result<Session> session = Session::open(at(file));
    EXPECT_TRUE(session.ok()) << (session ? "" : session.error().message);
    return session ? std::move(*session) : Session();
  }
  static std::string fingerprint(const Document& document) {
    std::string text;
    for (const ScanEntry& scan : document.scans)
      text += scan.id + scan.name + scan.sha256 + scan.noise.specification;
    for (const RegionEntry& region : document.regions) {
      text += region.id + region.name + (region.visible ? "+" : "-");
      for (const std::uint32_t id : *region.points) text += std::to_string(id) + ",";
    }
    for (const PatchEntry& patch : document.patches) text += patch.id + patch.name + result_hash(*patch.fit);
    return text;
  }
  void run(Session& session, const Command& command) const {
    const Result<void> done = session.run(command);
    ASSERT_TRUE(done.ok()) << done.error().message;
  }
  // Open, two regions, one patch, a rename undone and redone.
  void work(Session& session) const {
    for (const Command& command :
         std::vector<Command>{open_boxes(), lasso_left("region-1"), select_label("region-2", 8),
                              fit_plane("patch-1", "region-1"), Rename{"patch-1", "left"}, Undo{}, Redo{}}) {
      run(session, command);
    }
  }
};

TEST_F(SessionTest, WritesEachCommandBeforeItShows) {
  Session session = opened();
  EXPECT_EQ(text("work.patchlab"), journal_header() + "\n");
  run(session, open_boxes());
  EXPECT_THAT(text("work.patchlab"),
              HasSubstr("\n{\"do\":\"open_scan\",\"id\":\"scan-1\",\"file\":\"boxes.pcd\",\"sha256\":\""));
  run(session, Rename{"scan-1", "plates"});
  EXPECT_THAT(text("work.patchlab"),
              testing::EndsWith("\n{\"do\":\"rename\",\"target\":\"scan-1\",\"name\":\"plates\"}\n"));
}

TEST_F(SessionTest, KeepsNoCommandThatAJournalCannotHold) {
  Session session = opened();
  run(session, open_boxes());
  const std::string before = text("work.patchlab");
  EXPECT_THAT(session.run(Rename{"scan-1", "\xff"}).error().message, HasSubstr("not UTF-8"));
  Select lasso = lasso_left("region-1");
  lasso.camera.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(session.run(lasso).error().message, HasSubstr("camera.position[0] is not a number"));
  EXPECT_EQ(text("work.patchlab"), before);
  EXPECT_EQ(session.history().size(), 1u);
}

TEST_F(SessionTest, WritesNothingForACommandThatFails) {
  Session session = opened();
  run(session, open_boxes());
  const std::string before = text("work.patchlab");
  EXPECT_FALSE(session.run(Delete{"patch-7"}).ok());
  EXPECT_FALSE(session.run(Redo{}).ok());
  EXPECT_EQ(text("work.patchlab"), before);
  EXPECT_EQ(session.history().size(), 1u);
}

TEST_F(SessionTest, ComesBackAsItWasLeft) {
  std::string left;
  {
    Session session = opened();
    work(session);
    left = fingerprint(session.document());
  }
  Session session = opened();
  EXPECT_EQ(fingerprint(session.document()), left);
  EXPECT_EQ(session.document().patches.at(0).name, "left");
  EXPECT_EQ(session.position(), 5u);
  run(session, Undo{});
  EXPECT_EQ(session.document().patches.at(0).name, "patch-1");
}

TEST_F(SessionTest, ReplaysToTheSameDocumentEveryTime) {
  std::string left;
  {
    Session session = opened();
    work(session);
    left = fingerprint(session.document());
  }
  for (int time = 0; time < 2; ++time) {
    const Result<Document> document = replay(at("work.patchlab"));
    ASSERT_TRUE(document.ok()) << document.error().message;
    EXPECT_EQ(fingerprint(*document), left);
  }
}

TEST_F(SessionTest, UndoesAllAndRedoesAll) {
  Session session = opened();
  work(session);
  std::vector<std::string> states = {fingerprint(session.document())};
  while (session.can_undo()) {
    run(session, Undo{});
    states.push_back(fingerprint(session.document()));
  }
  EXPECT_EQ(states.size(), 6u);
  EXPECT_EQ(states.back(), "");
  for (auto state = states.rbegin() + 1; state != states.rend(); ++state) {
    run(session, Redo{});
    EXPECT_EQ(fingerprint(session.document()), *state);
  }
  EXPECT_FALSE(session.can_redo());
}

TEST_F(SessionTest, ForgetsWhatCouldBeRedoneAfterANewCommand) {
  Session session;
  run(session, [&] {
    auto open = open_boxes();
    open.file = at("boxes.pcd").string();
    return Command{open};
  }());
  run(session, Rename{"scan-1", "a"});
  run(session, Undo{});
  run(session, Rename{"scan-1", "b"});
  EXPECT_FALSE(session.can_redo());
  EXPECT_THAT(session.history(), ElementsAre("open boxes.pcd · 300 points", "rename scan-1 to b"));
}

TEST_F(SessionTest, KeepsTheSameDocumentOverAThousandRandomEditsUndoneAndRedone) {
  Session session;
  OpenScan open = open_boxes();
  open.file = at("boxes.pcd").string();
  run(session, open);
  Random random(1000);
  while (session.history().size() < 1000) {
    Select select = select_label("region-" + std::to_string(random.index(5)), random.index(2) == 0 ? 7 : 8);
    select.mode = random.index(2) == 0 ? SelectMode::set : SelectMode::add;
    run(session, select);
    if (random.index(10) == 0) run(session, Undo{});
  }
  const std::string before = fingerprint(session.document());
  while (session.can_undo()) run(session, Undo{});
  EXPECT_TRUE(session.document().scans.empty());
  while (session.can_redo()) run(session, Redo{});
  EXPECT_EQ(fingerprint(session.document()), before);
}

TEST_F(SessionTest, TellsASecondProgramThatTheJournalIsOpen) {
  const Session first = opened();
  const Result<Session> second = Session::open(at("work.patchlab"));
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().code, ErrorCode::refused);
  EXPECT_THAT(second.error().message, HasSubstr("open in another patchlab"));
}

TEST_F(SessionTest, LosesAtMostTheLastActionWhereverItsFileIsCut) {
  {
    Session session = opened();
    run(session, open_boxes());
    run(session, select_label("region-1", 7));
    run(session, Rename{"region-1", "left"});
  }
  const std::string whole = text("work.patchlab");
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    write("cut.patchlab", whole.substr(0, length));
    std::size_t whole_lines = 0;
    for (std::size_t i = 0; i < length; ++i) whole_lines += whole[i] == '\n';
    const bool at_line_end = length < whole.size() && whole[length] == '\n';
    const std::size_t lines = whole_lines + (at_line_end ? 1 : 0);
    {
      Session session = opened("cut.patchlab");
      ASSERT_EQ(session.history().size(), lines == 0 ? 0 : lines - 1) << "cut at byte " << length;
      if (!session.document().scans.empty()) run(session, Rename{"scan-1", "after the crash"});
    }
    const Result<Document> document = replay(at("cut.patchlab"));
    ASSERT_TRUE(document.ok()) << "cut at byte " << length << ": " << document.error().message;
    if (lines > 1) {
      ASSERT_EQ(document->scans.at(0).name, "after the crash");
    }
  }
}

TEST_F(SessionTest, LeavesAFileThatIsNoJournalAsItIs) {
  for (const std::string other :
       {"x,y,z\n0,0,0\n", "{\"some\":\"json\"}", "notes", "{\"format\":\"other\"}\n"}) {
    write("notes.txt", other);
    EXPECT_FALSE(Session::open(at("notes.txt")).ok());
    EXPECT_EQ(text("notes.txt"), other);
  }
}

TEST_F(SessionTest, LeavesAJournalThatCannotBeReplayedAsItIs) {
  const std::string journal = journal_header() + "\n{\"do\":\"delete\",\"target\":\"patch-1\"}\n{\"do\":\"un";
  write("bad.patchlab", journal);
  const Result<Session> session = Session::open(at("bad.patchlab"));
  ASSERT_FALSE(session.ok());
  EXPECT_THAT(session.error().message, HasSubstr("bad.patchlab: line 2: There is no"));
  EXPECT_EQ(text("bad.patchlab"), journal);
}

TEST_F(SessionTest, ChangesNeitherDocumentNorFileWhenTheDiskIsFull) {
  Session session = opened();
  run(session, open_boxes());
  const std::string before = text("work.patchlab");
  for (const rlim_t room : {1u, 10u, 20u}) {
    const test::FileSizeLimit limit(before.size() + room);
    const Result<void> done = session.run(Rename{"scan-1", "a name that does not fit into what is left"});
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().code, ErrorCode::unwritable);
    EXPECT_THAT(done.error().message, HasSubstr("the last action was not done"));
    EXPECT_EQ(session.document().scans.at(0).name, "boxes.pcd");
    EXPECT_EQ(text("work.patchlab"), before);
  }
  run(session, Rename{"scan-1", "there is room again"});
  EXPECT_EQ(replay(at("work.patchlab"))->scans.at(0).name, "there is room again");
}

TEST_F(SessionTest, RefusesDevicesAndFoldersAsJournals) {
  EXPECT_FALSE(Session::open("/dev/full").ok());
  EXPECT_FALSE(Session::open(at("")).ok());
  EXPECT_EQ(Session::open(at("missing/work.patchlab")).error().code, ErrorCode::unwritable);
}

TEST_F(SessionTest, NamesScansRelativeToTheJournal) {
  std::filesystem::create_directory(at("journals"));
  Session session = opened("journals/work.patchlab");
  EXPECT_EQ(session.scan_file(at("boxes.pcd")), "../boxes.pcd");
  OpenScan open = open_boxes();
  open.file = session.scan_file(at("boxes.pcd"));
  run(session, open);
  EXPECT_EQ(session.document().scans.size(), 1u);
}

TEST_F(SessionTest, ReplaysOnAnotherScan) {
  {
    Session session = opened();
    work(session);
  }
  write("later.pcd", text("boxes.pcd"));
  std::filesystem::remove(at("boxes.pcd"));
  EXPECT_EQ(replay(at("work.patchlab")).error().code, ErrorCode::unreadable);
  ApplyOptions options;
  options.on = at("later.pcd");
  const Result<Document> document = replay(at("work.patchlab"), options);
  ASSERT_TRUE(document.ok()) << document.error().message;
  EXPECT_EQ(document->scans.at(0).name, "later.pcd");
  EXPECT_EQ(document->patches.size(), 1u);
}

TEST_F(SessionTest, NamesTheLineWhoseScanHasChanged) {
  {
    Session session = opened();
    work(session);
  }
  write("boxes.pcd", text("boxes.pcd") + "\n");
  const Result<Document> document = replay(at("work.patchlab"));
  ASSERT_FALSE(document.ok());
  EXPECT_EQ(document.error().code, ErrorCode::refused);
  EXPECT_THAT(document.error().message, HasSubstr("work.patchlab: line 2: "));
}

}  // namespace
}  // namespace patchlab
