#include "engine/io/patch_set.h"
#include "tests/cli/program.h"
#include "tests/support/json_schema.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

class MapRobot : public Program {
 protected:
  static std::string asset(const std::string& file) {
    return std::string(PATCHLAB_SOURCE_DIR) + "/assets/" + file;
  }
  Outcome walker(const std::string& joints, const std::string& more = {}) const {
    return patchlab("map robot " + asset("walker.urdf") + " --joints " + joints + " --patches " +
                    asset("walker.patches.json") + " " + more);
  }
};

TEST_F(MapRobot, PutsTheWalkersPatchesIntoTheFrameOfItsBody) {
  const Outcome outcome = walker(asset("walker.joints.json"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(test::complaints("patch_set", json(outcome.out)), "");
  const Result<PatchSet> set = read_patch_set(outcome.out, "set");
  ASSERT_TRUE(set);
  ASSERT_EQ(set->patches.size(), 6u);
  EXPECT_EQ(json(outcome.out)["correlations"], "patches_share_errors") << "legs share joints";
  for (const PatchRecord& record : set->patches) {
    EXPECT_EQ(record.frame_id, "body");
    ASSERT_TRUE(record.patch.covariance_local);
    EXPECT_GT(record.patch.covariance_local->bottomRightCorner(3, 3).trace(), 1e-7) << record.id;
    EXPECT_EQ(record.patch.covariance_local->topLeftCorner(record.patch.type->boundary_size, 1).norm(), 0.0);
  }
  // The right foot stands flat: 0 - 0.35 + 0.7 - 0.35.
  EXPECT_NEAR(axes(set->patches[3].patch)(2, 2), -1.0, 1e-12);
}

TEST_F(MapRobot, SeesThemFromALinkToo) {
  const Outcome outcome = walker(asset("walker.joints.json"), "--frame right_foot");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Result<PatchSet> set = read_patch_set(outcome.out, "set");
  EXPECT_EQ(set->patches[3].frame_id, "right_foot");
  EXPECT_EQ(set->patches[3].patch.covariance_local->norm(), 0.0) << "a foot knows its own sole";
}

TEST_F(MapRobot, TakesJointsAsATable) {
  std::string table = "joint,value,sigma\n";
  const nlohmann::json joints = test::read_json(asset("walker.joints.json"))["joints"];
  for (const auto& [name, joint] : joints.items())
    table += name + "," + joint["value"].dump() + "," + joint["sigma"].dump() + "\r\n";
  const Outcome outcome = walker(write("joints.csv", table));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(read_patch_set(outcome.out, "set")->patches.size(), 6u);
}

TEST_F(MapRobot, SaysWhatIsMissingOrUnknown) {
  const std::pair<std::string, const char*> bad[] = {
      {R"({"joints": {}})", "joints.json: Joint \"left_hip_yaw\""},
      {R"({"joints": {"tail": {"value": 1}}})", "left_hip_yaw"},
      {R"({"joints": {"knee": {"value": "x"}}})", "knee.value"},
      {R"({"joints": {"knee": {"value": 1, "sigma": -1}}})", "sigma is negative"},
      {R"({"joints": 1})", "joints"},
      {"name;value", "header"},
      {"joint,value,sigma\nknee,wide,0", "line 2"},
      {"joint,value,sigma\nknee,1,0\nknee,2,0", "line 3"}};
  for (const auto& [text, says] : bad) {
    const Outcome outcome = walker(write("joints.json", text));
    EXPECT_THAT(outcome.status, testing::AnyOf(2, 3)) << text;
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
  }
  EXPECT_THAT(walker(asset("walker.joints.json"), "--frame tail").err,
              HasSubstr("--frame: There is no link \"tail\""));
  nlohmann::json patches = test::read_json(asset("walker.patches.json"));
  patches["patches"][0]["link"] = "hoof";
  const Outcome no_link =
      patchlab("map robot " + asset("walker.urdf") + " --joints " + asset("walker.joints.json") +
               " --patches " + write("hoof.json", patches.dump()));
  EXPECT_THAT(no_link.err, HasSubstr("hoof.json: Patch \"left_sole\": There is no link \"hoof\""));
  const Outcome not_robot =
      patchlab("map robot " + write("r.urdf", "<robot>") + " --joints " + asset("walker.joints.json") +
               " --patches " + asset("walker.patches.json"));
  EXPECT_EQ(not_robot.status, 3);
  EXPECT_TRUE(not_robot.one_sentence()) << not_robot.err;
}

TEST_F(MapRobot, FilesOfTheWalkerKeepToTheirSchemas) {
  EXPECT_EQ(test::complaints("robot_patches", test::read_json(asset("walker.patches.json"))), "");
  EXPECT_EQ(test::complaints("joints", test::read_json(asset("walker.joints.json"))), "");
}

}  // namespace
}  // namespace patchlab
