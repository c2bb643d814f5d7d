#include "tests/viewer/app/workbench_fixture.h"

#include <gtest/gtest.h>

#include "engine/patch/patch.h"

namespace patchlab::viewer {
namespace {

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

// While a lasso adds to a region its patch is fitted from where it stands; what is kept is fitted afresh.
TEST_F(WorkbenchTest, TheShownPatchIsWhereThePreviewOfAnAddingLassoStarts) {
  bench_.choose({SurfaceRequest::automatic, true});
  bench_.select(square(11));
  finish();
  const auto candidates = [this] { return bench_.document().patches.at(0).fit->report.candidates.size(); };
  const SurfaceType shown = bench_.document().patches.at(0).fit->patch.type->surface;
  const std::size_t compared = candidates();
  EXPECT_GT(compared, 1u);
  bench_.preview(square(13, SelectMode::add));
  finish();
  EXPECT_EQ(candidates(), 1u);
  EXPECT_EQ(bench_.document().patches.at(0).fit->patch.type->surface, shown);
  bench_.select(square(13, SelectMode::add));
  finish();
  EXPECT_EQ(candidates(), compared);
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

TEST_F(WorkbenchTest, ALargeRegionIsFittedToSomePointsAtOnceAndThenToAll) {
  bench_.choose({SurfaceRequest::plane, true});
  bench_.select(wall());
  std::size_t previewed = 0, one_in = 1;
  while (!bench_.idle()) {
    bench_.deliver();
    if (bench_.currency() != Currency::preview || previewed > 0) continue;
    previewed = bench_.document().patches.at(0).fit->report.points;
    one_in = bench_.fitted_one_in();
    EXPECT_GT(bench_.document().regions.at(0).points->size(), 20'000u) << "the region is whole";
  }
  finish();
  EXPECT_GT(one_in, 1u);
  EXPECT_GT(previewed, 100u);
  EXPECT_EQ(bench_.currency(), Currency::current);
  EXPECT_EQ(bench_.fitted_one_in(), 1u);
  EXPECT_GT(bench_.document().patches.at(0).fit->report.points, 2 * previewed);
}

TEST_F(WorkbenchTest, AStoppedFitLeavesItsPreviewAndKeepingFitsAll) {
  bench_.choose({SurfaceRequest::plane, true});
  bench_.select(wall());
  while (bench_.currency() != Currency::preview) bench_.deliver();
  bench_.cancel_work();
  finish();
  EXPECT_EQ(bench_.currency(), Currency::preview);
  EXPECT_TRUE(kept().patches.empty());
  bench_.keep();
  finish();
  ASSERT_EQ(kept().patches.size(), 1u);
  EXPECT_GT(kept().patches[0].fit->report.points, 20'000u) << "what is recorded is the fit of all points";
}

TEST_F(WorkbenchTest, AfterAScanIsDeletedTheSameViewSelectsFromWhatIsLeft) {
  bench_.open(folder_.ball());
  Stroke stroke = square(13);
  stroke.visible_only = true;
  bench_.select(stroke);
  finish();
  EXPECT_EQ(kept().regions.at(0).scan, "scan-2");
  bench_.run(Delete{"scan-2"});
  bench_.select(stroke);
  finish();
  ASSERT_EQ(kept().regions.size(), 1u);
  EXPECT_EQ(kept().regions[0].scan, "scan-1");
  EXPECT_GT(kept().regions[0].points->size(), 300u);
}

}  // namespace
}  // namespace patchlab::viewer
