#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/file.h"
#include "tests/engine/project/scan_folder.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

class Apply : public ScanFolder {
 protected:
  Error refused(const Document& before, Command command) const {
    const Result<Document> after = apply(before, command, here());
    return after ? Error{ErrorCode::usage, "accepted"} : after.error();
  }
};

TEST_F(Apply, OpensAScanAndRecordsItsHash) {
  Command open = open_boxes();
  const Result<Document> document = apply({}, open, here());
  ASSERT_TRUE(document.ok()) << document.error().message;
  EXPECT_EQ(std::get<OpenScan>(open).sha256, sha256(text("boxes.pcd")));
  ASSERT_NE(find_scan(*document, "scan-1"), nullptr);
  EXPECT_EQ(find_scan(*document, "scan-1")->name, "boxes.pcd");
  EXPECT_EQ(find_scan(*document, "scan-1")->scan->finite_count, 300u);
}

TEST_F(Apply, GivesFreeIdsWhereNoneAreAsked) {
  OpenScan open = open_boxes();
  open.id.clear();
  const Document document = after({open, select_label("", 7), fit_plane("", "region-1")});
  EXPECT_NE(find_scan(document, "scan-1"), nullptr);
  EXPECT_NE(find_patch(document, "patch-1"), nullptr);
}

TEST_F(Apply, RefusesAScanWhoseBytesAreNotTheRecordedOnes) {
  OpenScan open = open_boxes();
  open.sha256 = "5f0c";
  const Error error = refused({}, open);
  EXPECT_EQ(error.code, ErrorCode::refused);
  EXPECT_THAT(error.message, HasSubstr(sha256(text("boxes.pcd"))));
  EXPECT_THAT(error.message, HasSubstr("5f0c"));
}

TEST_F(Apply, TakesOtherBytesWhereAnotherScanIsNamed) {
  OpenScan open = open_boxes();
  open.sha256 = "5f0c";
  open.file = "gone.pcd";
  Command command = open;
  ApplyOptions options = here();
  options.on = at("boxes.pcd");
  EXPECT_TRUE(apply({}, command, options).ok());
}

TEST_F(Apply, RefusesUnknownAndTakenIds) {
  const Document document = after({open_boxes(), select_label("region-1", 7)});
  EXPECT_THAT(refused(document, open_boxes()).message, HasSubstr("'scan-1' is taken"));
  EXPECT_THAT(refused(document, fit_plane("patch-1", "region-9")).message, HasSubstr("no region 'region-9'"));
  EXPECT_THAT(refused(document, fit_plane("scan-1", "region-1")).message, HasSubstr("'scan-1' is taken"));
  EXPECT_THAT(refused(document, Rename{"patch-9", "x"}).message, HasSubstr("'patch-9'"));
  EXPECT_THAT(refused(document, Delete{"patch-9"}).message, HasSubstr("'patch-9'"));
  EXPECT_THAT(refused(document, Show{"patch-9"}).message, HasSubstr("'patch-9'"));
  EXPECT_THAT(refused(document, SetNoise{"scan-9", "kinect1"}).message, HasSubstr("no scan 'scan-9'"));
}

TEST_F(Apply, SelectsByLassoAndByLabelTheSameFinitePoints) {
  const Document document = after({open_boxes(), lasso_left("region-1"), select_label("region-2", 7)});
  EXPECT_EQ(find_region(document, "region-1")->points->size(), 150u);
  EXPECT_EQ(*find_region(document, "region-1")->points, *find_region(document, "region-2")->points);
}

TEST_F(Apply, CombinesSelections) {
  const auto size_after = [&](SelectMode mode) {
    Select again = select_label("region-1", 8);
    again.mode = mode;
    return find_region(after({open_boxes(), select_label("region-1", 7), again}), "region-1")->points->size();
  };
  EXPECT_EQ(size_after(SelectMode::set), 150u);
  EXPECT_EQ(size_after(SelectMode::add), 300u);
  EXPECT_EQ(size_after(SelectMode::subtract), 150u);
  EXPECT_EQ(size_after(SelectMode::intersect), 0u);
}

TEST_F(Apply, SortsTheIndicesOfARegion) {
  Select select{.region = "region-1", .scan = "scan-1"};
  select.indices = std::vector<std::uint32_t>{9, 3, 9, 1};
  EXPECT_THAT(*find_region(after({open_boxes(), select}), "region-1")->points, testing::ElementsAre(1, 3, 9));
}

TEST_F(Apply, RefusesIndicesBeyondTheScanAndLabelsThatAreNotThere) {
  const Document document = after({open_boxes()});
  Select beyond{.region = "region-1", .scan = "scan-1"};
  beyond.indices = std::vector<std::uint32_t>{0, 301};
  EXPECT_THAT(refused(document, beyond).message,
              HasSubstr("point 301 (counted from 0), but boxes.pcd has only 301"));
  EXPECT_EQ(refused(document, select_label("region-1", 9)).code, ErrorCode::no_finite_fit);
}

TEST_F(Apply, LeavesNothingOutWhereNothingIsHidden) {
  Select visible = lasso_left("region-1");
  visible.visible_only = true;
  EXPECT_EQ(*find_region(after({open_boxes(), visible}), "region-1")->points,
            *find_region(after({open_boxes(), lasso_left("region-1")}), "region-1")->points)
      << "nothing hides the plate";
}

TEST_F(Apply, LeavesASheetBehindASheetOutOfALassoOnVisiblePoints) {
  std::string table = "x,y,z\n";
  for (const char* depth : {"1.0", "1.2"}) {
    for (int i = 0; i < 900; ++i) {
      table += std::to_string(0.005 * (i % 30)) + "," + std::to_string(0.005 * (i / 30)) + "," + depth + "\n";
    }
  }
  write("sheets.csv", table);
  Select lasso = lasso_left("region-1");
  lasso.visible_only = true;
  lasso.polygon = {{0, 0}, {1280, 0}, {1280, 800}, {0, 800}};
  const OpenScan open{.id = "scan-1", .file = "sheets.csv", .noise = "isotropic:0.001"};
  const Document document = after({open, lasso});
  const RegionEntry& region = *find_region(document, "region-1");
  EXPECT_EQ(region.points->size(), 900u);
  EXPECT_EQ(region.points->back(), 899u);
  EXPECT_EQ(region.hidden_left_out, 900u);

  lasso.visible_only = false;
  const Document through = after({open, lasso});
  EXPECT_EQ(find_region(through, "region-1")->points->size(), 1800u);
  EXPECT_EQ(find_region(through, "region-1")->hidden_left_out, 0u);
}

TEST_F(Apply, ReshapesARegion) {
  const auto size_after = [&](Reshaping how, int steps = 1) {
    return find_region(after({open_boxes(), select_label("region-1", 7), Reshape{"region-1", how, steps}}),
                       "region-1")
        ->points->size();
  };
  EXPECT_EQ(size_after(Reshaping::invert), 150u);
  EXPECT_GE(size_after(Reshaping::grow, 2), size_after(Reshaping::grow));
  EXPECT_LE(size_after(Reshaping::shrink, 2), size_after(Reshaping::shrink));
  EXPECT_GE(size_after(Reshaping::linked), 150u);
  EXPECT_THAT(refused(after({open_boxes()}), Reshape{"region-1", Reshaping::grow, 1}).message,
              HasSubstr("no region 'region-1'"));
}

TEST_F(Apply, FloodsTheSurfaceThatWasPointedAt) {
  const Document document = after({open_boxes(), select_label("region-1", 7)});
  const Scan& scan = *document.scans[0].scan;
  Select surface{.region = "region-2", .scan = "scan-1"};
  surface.flood = scan.point(find_region(document, "region-1")->points->at(70));
  const std::vector<std::uint32_t> flooded = *find_region(after({open_boxes(), surface}), "region-2")->points;
  EXPECT_GE(flooded.size(), 150u);
  for (const std::uint32_t id : *find_region(document, "region-1")->points) {
    EXPECT_TRUE(std::ranges::binary_search(flooded, id)) << id;
  }
}

TEST_F(Apply, FitsAndRecordsTheHashOfTheResult) {
  const Document document = after({open_boxes(), select_label("region-1", 7)});
  Command fit = fit_plane("patch-1", "region-1");
  const Result<Document> fitted = apply(document, fit, here());
  ASSERT_TRUE(fitted.ok()) << fitted.error().message;
  const PatchEntry& patch = *find_patch(*fitted, "patch-1");
  EXPECT_EQ(std::get<Fit>(fit).result_sha256, result_hash(*patch.fit));
  EXPECT_EQ(patch.fit->report.residuals.size(), patch.points->size());
  EXPECT_EQ(patch.fit->patch.type->surface, SurfaceType::plane);
  EXPECT_TRUE(apply(document, fit, here()).ok()) << "the recorded hash is that of the same fit";
}

TEST_F(Apply, SaysOfAFitThatItComesOutOtherwiseThanRecorded) {
  const Document document = after({open_boxes(), select_label("region-1", 7)});
  Fit fit = fit_plane("patch-1", "region-1");
  fit.result_sha256 = "9b1d";
  Command command = fit;
  const Result<Document> fitted = apply(document, command, here());
  ASSERT_TRUE(fitted.ok()) << fitted.error().message;
  const PatchEntry& patch = *find_patch(*fitted, "patch-1");
  EXPECT_TRUE(patch.differs_from_record);
  EXPECT_EQ(std::get<Fit>(command).result_sha256, result_hash(*patch.fit))
      << "what stands is recorded from now on";
  EXPECT_THAT(notice_of_other_results(*fitted).value_or(""),
              HasSubstr("The fit of patch-1 gives other results"));
  ASSERT_TRUE(apply(document, command, here()).ok());
  EXPECT_EQ(notice_of_other_results(*apply(document, command, here())), std::nullopt);
}

TEST_F(Apply, HashesEveryBitOfAResult) {
  const Document document =
      after({open_boxes(), select_label("region-1", 7), fit_plane("patch-1", "region-1")});
  const FitResult& fit = *find_patch(document, "patch-1")->fit;
  FitResult other = fit;
  other.patch.parameters[0] = std::nextafter(other.patch.parameters[0], 1.0);
  EXPECT_NE(result_hash(other), result_hash(fit));
  other = fit;
  (*other.patch.covariance)(0, 0) *= 2.0;
  EXPECT_NE(result_hash(other), result_hash(fit));
}

TEST_F(Apply, LeavesPatchesAloneWhenTheirRegionChangesOrGoes) {
  const std::vector<Command> commands = {open_boxes(), select_label("region-1", 7),
                                         fit_plane("patch-1", "region-1")};
  const Document before = after(commands);
  Command other = select_label("region-1", 8);
  Command erase = Delete{"region-1"};
  const Document changed = *apply(before, other, here());
  const Document erased = *apply(changed, erase, here());
  EXPECT_EQ(find_patch(erased, "patch-1")->fit, find_patch(before, "patch-1")->fit);
  EXPECT_TRUE(erased.regions.empty());
}

TEST_F(Apply, FitsThePatchesOfAScanAgainWhenItsNoiseChanges) {
  const Document before =
      after({open_boxes(), select_label("region-1", 7), fit_plane("patch-1", "region-1")});
  Command noise = SetNoise{"scan-1", "isotropic:0.002"};
  const Result<Document> document = apply(before, noise, here());
  ASSERT_TRUE(document.ok()) << document.error().message;
  const auto variance = [](const Document& d) {
    return d.patches[0].fit->patch.covariance_local->diagonal().tail<1>()(0);
  };
  EXPECT_NEAR(variance(*document) / variance(before), 4.0, 1e-3);
  EXPECT_EQ(find_scan(*document, "scan-1")->noise.specification, "isotropic:0.002");
}

TEST_F(Apply, RenamesHidesAndDeletes) {
  const Document document =
      after({open_boxes(), select_label("region-1", 7), fit_plane("patch-1", "region-1"),
             Rename{"region-1", "left"}, Show{"scan-1", false}});
  EXPECT_EQ(find_region(document, "region-1")->name, "left");
  EXPECT_FALSE(find_scan(document, "scan-1")->visible);
  Command erase = Delete{"scan-1"};
  const Document empty = *apply(document, erase, here());
  EXPECT_TRUE(empty.scans.empty() && empty.regions.empty() && empty.patches.empty());
}

TEST_F(Apply, ChangesNothingInTheDocumentBefore) {
  const Document before = after({open_boxes(), select_label("region-1", 7)});
  Command rename = Rename{"region-1", "left"};
  ASSERT_TRUE(apply(before, rename, here()).ok());
  EXPECT_EQ(find_region(before, "region-1")->name, "region-1");
}

TEST_F(Apply, ColourIsThatOfARegionAndItsPatchesUntilItIsTakenBack) {
  const Colour red = {200, 10, 20}, blue = {1, 2, 250};
  Document document = after({open_boxes(), lasso_left("region-1"), fit_plane("patch-1", "region-1"),
                             SetColour{"patch-1", red}, fit_plane("patch-2", "region-1")});
  EXPECT_EQ(find_region(document, "region-1")->colour, red);
  EXPECT_EQ(find_patch(document, "patch-1")->colour, red);
  EXPECT_EQ(find_patch(document, "patch-2")->colour, red);
  for (const std::optional<Colour>& colour : {std::optional(blue), std::optional<Colour>()}) {
    Command command = SetColour{"region-1", colour};
    document = *apply(document, command, here());
    EXPECT_EQ(find_region(document, "region-1")->colour, colour);
    EXPECT_EQ(find_patch(document, "patch-2")->colour, colour);
  }
  Command nowhere = SetColour{"region-9", red};
  EXPECT_FALSE(apply(document, nowhere, here()));
}

TEST_F(Apply, DescribesWhatWasDone) {
  const Document document = after({open_boxes(), lasso_left("region-1"), Rename{"region-1", "left plate"},
                                   fit_plane("patch-1", "region-1")});
  EXPECT_EQ(describe(open_boxes(), document), "open boxes.pcd · 300 points");
  EXPECT_EQ(describe(lasso_left("region-1"), document), "lasso left plate · 150 points");
  EXPECT_EQ(describe(fit_plane("patch-1", "region-1"), document), "fit patch-1 · plane · 150 points");
  EXPECT_EQ(describe(Show{"region-1", false}, document), "hide left plate");
}

}  // namespace
}  // namespace patchlab
