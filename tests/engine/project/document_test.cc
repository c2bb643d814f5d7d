#include "engine/project/document.h"

#include <gtest/gtest.h>

#include "tests/engine/project/scan_folder.h"

namespace patchlab {
namespace {

using PatchSetOfDocument = ScanFolder;

TEST(FreeId, IsTheFirstThatNothingHas) {
  Document document;
  EXPECT_EQ(free_id(document, "patch"), "patch-1");
  document.regions.emplace_back().id = "patch-1";
  document.patches.emplace_back().id = "patch-2";
  EXPECT_EQ(free_id(document, "patch"), "patch-3");
  EXPECT_EQ(free_id(document, "scan"), "scan-1");
}

TEST_F(PatchSetOfDocument, NamesSourcesRegionsAndTheJournal) {
  const Document document = after({open_boxes(), select_label("region-1", 7),
                                   fit_plane("patch-1", "region-1"), Rename{"patch-1", "left"}});
  const PatchSet set = patch_set(document, "work.patchlab");
  ASSERT_EQ(set.sources.size(), 1u);
  EXPECT_EQ(set.sources[0].file, "boxes.pcd");
  EXPECT_EQ(set.sources[0].sha256.size(), 64u);
  EXPECT_EQ(set.sources[0].noise, "isotropic:0.001");
  EXPECT_FALSE(set.sources[0].noise_assumed);
  ASSERT_EQ(set.patches.size(), 1u);
  EXPECT_EQ(set.patches[0].name, "left");
  EXPECT_EQ(set.patches[0].source, "scan-1");
  EXPECT_EQ(set.patches[0].provenance,
            (nlohmann::json{{"region", "region-1"}, {"journal", "work.patchlab"}}));
  EXPECT_EQ(set.patches[0].fit->points, 150u);
}

TEST_F(PatchSetOfDocument, CallsTheFrameSensorOnlyWhereTheViewpointIsTheIdentity) {
  OpenScan moved = open_boxes();
  moved.viewpoint = Eigen::Vector3d(0, 0, -1);
  const std::vector<Command> rest = {select_label("region-1", 7), fit_plane("patch-1", "region-1")};
  EXPECT_EQ(patch_set(after({open_boxes(), rest[0], rest[1]})).patches[0].frame_id, "sensor");
  EXPECT_EQ(patch_set(after({moved, rest[0], rest[1]})).patches[0].frame_id, "world");
}

}  // namespace
}  // namespace patchlab
