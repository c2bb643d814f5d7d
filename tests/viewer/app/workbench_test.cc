#include "viewer/app/workbench.h"

#include <gtest/gtest.h>

#include <thread>

#include "engine/patch/patch.h"
#include "tests/support/file_size_limit.h"
#include "tests/viewer/app/ball_scan.h"
#include "viewer/app/journal_file.h"
#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {
namespace {

class WorkbenchTest : public testing::Test {
 protected:
  WorkbenchTest() {
    bench_.choose({SurfaceRequest::sphere, true});
    bench_.open(folder_.ball());
    finish();
  }

  void finish() {
    while (!bench_.idle()) {
      bench_.deliver();
      std::this_thread::yield();
    }
    bench_.deliver();
    for (const Error& error : bench_.take_errors()) errors_.push_back(error.message);
  }

  // A square of the screen of the sensor: the ball is 39 pixels wide there.
  Stroke square(double half_width, SelectMode mode = SelectMode::set) const {
    const ViewCamera camera = view_camera(from_sensor({}, 0.8, 2 * std::atan(120 / 262.5)), 320, 240);
    const double h = half_width;
    return {mode, {{160 - h, 120 - h}, {160 + h, 120 - h}, {160 + h, 120 + h}, {160 - h, 120 + h}}, camera};
  }
  Document kept() const { return bench_.session().document(); }

  TestFolder folder_;
  std::vector<std::string> errors_;
  Workbench bench_{{folder_.path() / "state", true}, [] {}};
};

TEST_F(WorkbenchTest, AScanThatIsOpenedBeginsAJournal) {
  ASSERT_EQ(kept().scans.size(), 1u);
  EXPECT_EQ(bench_.session().journal().parent_path(), folder_.path() / "state");
  EXPECT_EQ(bench_.session().history().size(), 1u);
  EXPECT_EQ(bench_.take_selection(), "scan-1");
}

TEST_F(WorkbenchTest, APreviewIsShownButNotRecorded) {
  bench_.preview(square(13));
  EXPECT_EQ(bench_.currency(), Currency::fitting);
  finish();
  EXPECT_EQ(bench_.currency(), Currency::current);
  EXPECT_EQ(bench_.document().patches.size(), 1u);
  EXPECT_TRUE(kept().patches.empty());
  EXPECT_TRUE(kept().regions.empty());
  bench_.drop_preview();
  EXPECT_TRUE(bench_.document().patches.empty());
  EXPECT_EQ(bench_.currency(), Currency::nothing);
}

TEST_F(WorkbenchTest, ASelectionIsRecordedAndItsFitIsKeptOnRequest) {
  bench_.select(square(13));
  finish();
  ASSERT_EQ(kept().regions.size(), 1u);
  EXPECT_TRUE(kept().patches.empty());
  EXPECT_EQ(bench_.draft_patch(), "patch-1");
  bench_.keep();
  finish();
  ASSERT_EQ(kept().patches.size(), 1u);
  EXPECT_TRUE(bench_.draft_patch().empty());
  const Patch& patch = kept().patches[0].fit->patch;
  const double sigma = std::sqrt((*patch.covariance_local)(1, 1));
  EXPECT_NEAR(curvatures(patch)[0], -1 / ball_radius, 4 * sigma);
  EXPECT_TRUE(errors_.empty()) << errors_[0];
}

TEST_F(WorkbenchTest, KeepWaitsForTheFitOfThePresentSelection) {
  bench_.select(square(13));
  bench_.keep();  // nothing is there yet
  finish();
  EXPECT_EQ(kept().patches.size(), 1u);
}

TEST_F(WorkbenchTest, WhatIsKeptIsWhatAReplayOfTheJournalGives) {
  bench_.select(square(13));
  bench_.keep();
  finish();
  const Result<Document> replayed = replay(bench_.session().journal());
  ASSERT_TRUE(replayed) << replayed.error().message;
  ASSERT_EQ(replayed->patches.size(), 1u);
  EXPECT_EQ(result_hash(*replayed->patches[0].fit), result_hash(*kept().patches[0].fit));
}

TEST_F(WorkbenchTest, ANewContourLeavesAKeptPatchAloneAndReplacesWhatIsNotKept) {
  bench_.select(square(13));
  finish();
  bench_.select(square(12));
  finish();
  EXPECT_EQ(kept().regions.size(), 1u);
  bench_.keep();
  finish();
  bench_.select(square(11));
  finish();
  EXPECT_EQ(kept().regions.size(), 2u);
  EXPECT_EQ(bench_.draft_patch(), "patch-2");
}

TEST_F(WorkbenchTest, AddAndSubtractChangeTheRegionInFocus) {
  bench_.select(square(13));
  finish();
  const std::size_t whole = kept().regions[0].points->size();
  bench_.select(square(5, SelectMode::subtract));
  finish();
  const std::size_t rest = kept().regions[0].points->size();
  EXPECT_LT(rest, whole);
  bench_.select(square(5, SelectMode::add));
  finish();
  EXPECT_EQ(kept().regions[0].points->size(), whole);
  EXPECT_EQ(kept().regions.size(), 1u);
}

TEST_F(WorkbenchTest, AContourOnVisiblePointsLeavesTheHiddenOnesOutAndSaysHowMany) {
  Stroke behind = square(10);
  // From the side, the ball hides wall that the sensor saw beside it.
  OrbitCamera camera = from_sensor({}, 0.8, 2 * std::atan(120 / 262.5));
  camera.orbit(0.7, 0.0);
  behind.camera = view_camera(camera, 320, 240);
  bench_.select(behind);
  finish();
  const std::size_t through = kept().regions.at(0).points->size();
  behind.visible_only = true;
  bench_.select(behind);
  finish();
  const RegionEntry region = kept().regions.at(0);
  EXPECT_LT(region.points->size(), through);
  EXPECT_EQ(region.points->size() + region.hidden_left_out, through);
  EXPECT_EQ(replay(bench_.session().journal())->regions.at(0).hidden_left_out, region.hidden_left_out);
}

TEST_F(WorkbenchTest, AClickTakesTheSurfaceAndItsPatchIsFitted) {
  Stroke click;
  click.surface_at = ball_centre - Eigen::Vector3d(0, 0, ball_radius);
  click.scan = "scan-1";
  bench_.select(click);
  finish();
  ASSERT_EQ(kept().regions.size(), 1u);
  EXPECT_GT(kept().regions[0].points->size(), 300u);
  EXPECT_EQ(bench_.draft_patch(), "patch-1");
  const Scan& scan = *kept().scans[0].scan;
  std::size_t off = 0;
  for (const std::uint32_t id : *kept().regions[0].points)
    off += (scan.point(id) - ball_centre).norm() > 0.09;
  EXPECT_EQ(off, 0u) << "points of the wall";
}

TEST_F(WorkbenchTest, ARegionIsReshapedAsAStepThatCanBeUndone) {
  bench_.select(square(13));
  finish();
  const auto points = [this] { return kept().regions.at(0).points->size(); };
  const std::size_t before = points();
  bench_.reshape(Reshaping::grow);
  finish();
  const std::size_t grown = points();
  EXPECT_GT(grown, before);
  EXPECT_EQ(bench_.draft_patch(), "patch-1") << "the fit follows";
  bench_.reshape(Reshaping::shrink);
  finish();
  EXPECT_LT(points(), grown);
  for (int i = 0; i < 2; ++i) bench_.undo();
  finish();
  EXPECT_EQ(points(), before);
  const Result<Document> replayed = replay(bench_.session().journal());
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_EQ(replayed->regions.at(0).points->size(), before);
}

TEST_F(WorkbenchTest, ReshapingNothingIsTold) {
  bench_.take_notices();
  bench_.reshape(Reshaping::grow);
  finish();
  EXPECT_EQ(bench_.take_notices().size(), 1u);
  EXPECT_EQ(bench_.session().history().size(), 1u);
}

TEST_F(WorkbenchTest, AnotherNoiseModelRefitsWhatIsKeptAndWhatIsNot) {
  const auto sigma = [](const Document& document) {
    return std::sqrt((*document.patches.at(0).fit->patch.covariance_local)(1, 1));
  };
  bench_.select(square(13));
  finish();
  const double before = sigma(bench_.document());
  bench_.set_noise("scan-1", "isotropic:0.005");
  finish();
  EXPECT_GT(sigma(bench_.document()), 1.5 * before);
  EXPECT_EQ(bench_.draft_patch(), "patch-1");
  bench_.keep();
  bench_.set_noise("scan-1", "kinect1");
  finish();
  EXPECT_TRUE(bench_.draft_patch().empty());
  EXPECT_DOUBLE_EQ(sigma(kept()), before);
  EXPECT_DOUBLE_EQ(sigma(*replay(bench_.session().journal())), before);
  bench_.undo();
  finish();
  EXPECT_GT(sigma(kept()), 1.5 * before);
}

TEST_F(WorkbenchTest, AWrongNoiseModelIsToldAndChangesNothing) {
  bench_.set_noise("scan-1", "isotropic:much");
  finish();
  ASSERT_EQ(errors_.size(), 1u);
  EXPECT_EQ(bench_.session().history().size(), 1u);
  EXPECT_EQ(bench_.currency(), Currency::nothing);
}

TEST_F(WorkbenchTest, NothingIsSelectedFromAScanThatIsHidden) {
  bench_.run(Show{"scan-1", false});
  bench_.take_notices();
  bench_.preview(square(13));
  bench_.select(square(13));
  finish();
  EXPECT_TRUE(bench_.document().regions.empty());
  EXPECT_EQ(bench_.take_notices().size(), 1u);
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

TEST_F(WorkbenchTest, TakingAwayFromNothingIsToldAndChangesNothing) {
  (void)bench_.take_notices();
  bench_.select(square(13, SelectMode::subtract));
  finish();
  EXPECT_TRUE(kept().regions.empty());
  EXPECT_EQ(bench_.take_notices().size(), 1u);
  EXPECT_TRUE(errors_.empty());
}

TEST_F(WorkbenchTest, UndoAndRedoGoThroughEveryStep) {
  bench_.select(square(13));
  bench_.keep();
  finish();
  bench_.run(Rename{"patch-1", "ball front"});
  finish();
  EXPECT_EQ(kept().patches[0].name, "ball front");
  bench_.undo();
  bench_.undo();
  finish();
  EXPECT_TRUE(kept().patches.empty());
  EXPECT_EQ(bench_.draft_patch(), "patch-1");  // the fit is live again
  bench_.undo();
  finish();
  EXPECT_TRUE(kept().regions.empty());
  EXPECT_TRUE(bench_.document().patches.empty());
  for (int i = 0; i < 3; ++i) bench_.redo();
  finish();
  EXPECT_EQ(kept().patches.at(0).name, "ball front");
  bench_.go_to(1);
  finish();
  EXPECT_EQ(bench_.session().position(), 1u);
  EXPECT_EQ(bench_.session().history().size(), 4u);
}

TEST_F(WorkbenchTest, AnotherSurfaceIsFittedAtOnceToWhatIsInFocus) {
  bench_.select(square(9));
  finish();
  bench_.choose({SurfaceRequest::plane, true});
  finish();
  ASSERT_EQ(bench_.document().patches.size(), 1u);
  EXPECT_EQ(bench_.document().patches[0].fit->patch.type->surface, SurfaceType::plane);
}

TEST_F(WorkbenchTest, TooFewPointsGiveNoPatchAndAReason) {
  bench_.select(square(0.7));
  finish();
  EXPECT_EQ(bench_.currency(), Currency::failed);
  EXPECT_FALSE(bench_.fit_message().empty());
  EXPECT_TRUE(bench_.draft_patch().empty());
  bench_.keep();
  finish();
  EXPECT_TRUE(kept().patches.empty());
}

TEST_F(WorkbenchTest, ADeletedPatchDoesNotComeBackByItself) {
  bench_.select(square(13));
  bench_.keep();
  finish();
  bench_.run(Delete{"patch-1"});
  finish();
  EXPECT_TRUE(bench_.document().patches.empty());
}

TEST_F(WorkbenchTest, AFileThatCannotBeReadIsToldAndTheSessionStays) {
  bench_.open(folder_.path() / "missing.pcd");
  finish();
  ASSERT_EQ(errors_.size(), 1u);
  EXPECT_NE(errors_[0].find("missing.pcd"), std::string::npos);
  EXPECT_EQ(kept().scans.size(), 1u);
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
