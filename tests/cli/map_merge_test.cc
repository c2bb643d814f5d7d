#include "engine/io/patch_set.h"
#include "tests/cli/program.h"
#include "tests/support/json_schema.h"
#include "tests/support/sample_patches.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

// Patches of several types in a row, each with a small covariance, moved by `by` and seen from `frame`.
PatchSet row_of_patches(const std::string& frame, const Pose& by, std::size_t first, std::size_t count,
                        const std::string& sha256 = "aa") {
  const std::vector<test::SamplePatch> samples = test::sample_patches();
  PatchSet set;
  set.sources.push_back({"scan-1", frame + ".pcd", sha256, "kinect1", false, {}, nlohmann::json::object()});
  for (std::size_t i = first; i < first + count; ++i) {
    const Patch& sample = samples[i].patch;
    const PatchMatrix cov = 1e-6 * PatchMatrix::Identity(sample.type->size(), sample.type->size());
    const Patch placed = make_patch(*sample.type, boundary(sample), curvatures(sample), axes(sample),
                                    Vector3d(0.5 * static_cast<double>(i), 0.0, 0.0), cov);
    PatchRecord record;
    record.id = "patch-" + std::to_string(i);
    record.frame_id = frame;
    record.source = "scan-1";
    record.patch = transform(by, placed);
    set.patches.push_back(record);
  }
  return set;
}

class MapMerge : public Program {
 protected:
  std::string set_file(const std::string& file, const PatchSet& set) const {
    return write(file, *write_patch_set(set));
  }
};

TEST_F(MapMerge, FusesWhatBothSeeAndAddsTheRest) {
  const std::string a = set_file("a.json", row_of_patches("map", {}, 0, 4));
  const Pose camera_from_map{Vector3d(0.2, -0.1, 0.4), Vector3d(1.0, 0.3, -0.2)};
  const std::string b = set_file("b.json", row_of_patches("camera", camera_from_map, 1, 4, "bb"));
  const Pose map_from_camera = inverse(camera_from_map);
  nlohmann::json pose = {{"r", {map_from_camera.r.x(), map_from_camera.r.y(), map_from_camera.r.z()}},
                         {"t", {map_from_camera.t.x(), map_from_camera.t.y(), map_from_camera.t.z()}}};
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j)
      pose["covariance"][static_cast<std::size_t>(i)].push_back(i == j ? 1e-5 : 0.0);
  }
  const std::string file = write("pose.json", pose.dump());
  const Outcome outcome = patchlab("map merge " + a + " " + b + " --pose " + file);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("3 of 4 patches matched and fused, 1 added."));
  const Result<PatchSet> map = read_patch_set(outcome.out, "map");
  ASSERT_TRUE(map) << map.error().message;
  ASSERT_EQ(map->patches.size(), 5u);
  EXPECT_EQ(json(outcome.out)["correlations"], "patches_share_errors") << "the pose is uncertain";
  const Outcome again = patchlab("map merge " + write("map.json", outcome.out) + " " + a);
  EXPECT_EQ(again.status, 2) << "the map reads back, and holds a";
  EXPECT_EQ(map->sources.size(), 2u) << "two scans of one id are two sources";
  const PatchRecord& fused = map->patches[2];
  EXPECT_EQ(fused.id, "patch-2");
  EXPECT_EQ(fused.frame_id, "map");
  EXPECT_EQ(fused.unknown["observations"].size(), 2u);
  EXPECT_EQ(fused.unknown["bound_derived"], true);
  EXPECT_EQ(map->patches[0].unknown["observations"].size(), 1u);
  EXPECT_EQ(map->patches[4].id, "patch-4");
  EXPECT_EQ(map->patches[4].source, "scan-1@bb");
}

TEST_F(MapMerge, GoesOnWithAMapThatItWrote) {
  const std::string a = set_file("a.json", row_of_patches("map", {}, 0, 2)),
                    b = set_file("b.json", row_of_patches("map", {}, 0, 2, "bb")),
                    c = set_file("c.json", row_of_patches("map", {}, 0, 2, "cc"));
  const std::string map = at("map.json").string();
  const Outcome first = patchlab("map merge " + a + " " + b + " -o " + map);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(json(text("map.json"))["correlations"], "patches_independent");
  const Outcome second = patchlab("map merge " + map + " " + c);
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(read_patch_set(second.out, "map")->patches[0].unknown["observations"].size(), 3u);
  EXPECT_EQ(patchlab("map merge " + map + " " + c).out, second.out);
}

TEST_F(MapMerge, KeepsWhenASightWas) {
  const std::string a = set_file("a.json", row_of_patches("map", {}, 0, 2)),
                    b = set_file("b.json", row_of_patches("map", {}, 0, 2, "bb")),
                    c = set_file("c.json", row_of_patches("map", {}, 0, 2, "cc"));
  const Outcome first = patchlab("map merge " + a + " " + b + " --when 2026-11-23T14:02:11Z");
  const Outcome second = patchlab("map merge " + write("map.json", first.out) + " " + c);
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(test::complaints("patch_set", json(second.out)), "");
  const nlohmann::json seen = json(second.out)["patches"][0]["observations"];
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_FALSE(seen[0].contains("when")) << "nobody said";
  EXPECT_EQ(seen[1]["when"], "2026-11-23T14:02:11Z");
  EXPECT_FALSE(seen[2].contains("when"));
}

TEST_F(MapMerge, RefusesAMapThatSawNothing) {
  const std::string a = set_file("a.json", row_of_patches("map", {}, 0, 1)),
                    b = set_file("b.json", row_of_patches("map", {}, 0, 1, "bb"));
  nlohmann::json map = json(patchlab("map merge " + a + " " + b).out);
  map["patches"][0]["observations"] = nlohmann::json::array();
  const Outcome outcome = patchlab("map merge " + write("map.json", map.dump()) + " " + b);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("map.json: observations of patch \"patch-0\" are none"));
}

TEST_F(MapMerge, CountsASightOnce) {
  const std::string a = set_file("a.json", row_of_patches("map", {}, 0, 2)),
                    b = set_file("b.json", row_of_patches("map", {}, 0, 2, "bb"));
  const std::string map = at("map.json").string();
  ASSERT_EQ(patchlab("map merge " + a + " " + b + " -o " + map).status, 0);
  for (const std::string& again : {a, b}) {
    const Outcome outcome = patchlab("map merge " + map + " " + again);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("\"patch-0\" is in"));
  }
}

TEST_F(MapMerge, AsksForThePoseBetweenTwoFrames) {
  const std::string a = set_file("a.json", row_of_patches("map", {}, 0, 2)),
                    b = set_file("b.json", row_of_patches("camera", {}, 0, 2));
  const Outcome outcome = patchlab("map merge " + a + " " + b);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("--pose"));
  EXPECT_EQ(patchlab("map merge " + a + " " + b + " --gate 1.5").status, 2);
  EXPECT_EQ(patchlab("map merge " + a + " nowhere.json").status, 3);
  EXPECT_EQ(
      patchlab("map merge " + a + " " + b + " --pose " + write("pose.json", R"({"r": [0, 0, 0]})")).status,
      3);
}

}  // namespace
}  // namespace patchlab
