#include "engine/io/patch_set.h"
#include "tests/cli/program.h"
#include "tests/support/json_schema.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

constexpr double sigma_ground = 0.01, sigma_foot = 0.001;  // m, and rad

PatchRecord ground_plate(const std::string& id, const std::string& frame, const Pose& at, double sigma) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::circle);
  const PatchMatrix cov = sigma * sigma * PatchMatrix::Identity(type.size(), type.size());
  PatchRecord record;
  record.id = id;
  record.frame_id = frame;
  record.patch = make_patch(type, {type.boundary, Eigen::VectorXd::Constant(1, 0.05)}, Eigen::VectorXd(),
                            exp_map(at.r), at.t, cov);
  return record;
}

class MapTouch : public Program {
 protected:
  MapTouch() {
    PatchSet ground, robot;
    ground.patches = {ground_plate("step", "map", {}, sigma_ground)};
    // The sole faces down, 8 mm above where the step was seen.
    robot.patches = {ground_plate("sole", "body", {{3.14159, 0.0, 0.0}, {1.0, 0.0, 0.008}}, sigma_foot)};
    ground_ = write("ground.json", *write_patch_set(ground));
    robot_ = write("robot.json", *write_patch_set(robot));
    pose_ = write("pose.json", R"({"elements": [{"r": [0, 0, 0], "t": [-1, 0, 0]}]})");
  }
  std::string ground_, robot_, pose_;
};

TEST_F(MapTouch, MovesAPatchToTheFootThatStandsOnIt) {
  const Outcome outcome = patchlab("map touch " + ground_ + " --patch step --foot " + robot_ +
                                   " --id sole --pose " + pose_ + " --when 2026-11-23T14:02:11Z");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("step touched: distance 0.80"));
  EXPECT_EQ(test::complaints("patch_set", json(outcome.out)), "");
  const PatchRecord step = read_patch_set(outcome.out, "map")->patches[0];
  EXPECT_NEAR(centre(step.patch).z(), 0.008, 1e-4);
  const int at = step.patch.type->position_at() + 2;
  EXPECT_NEAR((*step.patch.covariance_local)(at, at), sigma_foot * sigma_foot, 2e-8);
  EXPECT_EQ(step.unknown["observations"].size(), 1u) << "what was seen stays";
  EXPECT_EQ(step.unknown["touches"][0]["foot"], "sole");
  EXPECT_EQ(step.unknown["touches"][0]["when"], "2026-11-23T14:02:11Z");
}

TEST_F(MapTouch, TakesPointsOneAfterTheOther) {
  const std::string touch = " --patch step --sigma 0.001 --point ";
  const Outcome one = patchlab("map touch " + ground_ + touch + "0.03,0,0.002");
  ASSERT_EQ(one.status, 0) << one.err;
  const Outcome two = patchlab("map touch " + write("one.json", one.out) + touch + "-0.03,0,0.002");
  ASSERT_EQ(two.status, 0) << two.err;
  const PatchRecord step = read_patch_set(two.out, "map")->patches[0];
  EXPECT_EQ(step.unknown["touches"].size(), 2u);
  EXPECT_NEAR(centre(step.patch).z(), 0.002, 2e-4);
}

TEST_F(MapTouch, SaysWhyItDoesNot) {
  const std::string step = ground_ + " --patch step";
  const std::tuple<std::string, int, const char*> bad[] = {
      {ground_ + " --patch stair --point 0,0,0 --sigma 0.001", 2,
       "ground.json: no patch is called \"stair\""},
      {step, 2, "What touched it?"},
      {step + " --point 0,0,0", 2, "--sigma"},
      {step + " --point 0,0,0.1 --sigma 0.001", 1, "contradicts patch \"step\""},
      {step + " --foot " + robot_, 2, "Give --id"},
      {step + " --foot " + robot_ + " --id toe", 2, "there are: sole"},
      {step + " --foot " + robot_ + " --id sole", 2, "--pose"},
      {step + " --foot " + pose_ + " --id sole", 3, "pose.json"}};
  for (const auto& [request, status, says] : bad) {
    const Outcome outcome = patchlab("map touch " + request);
    EXPECT_EQ(outcome.status, status) << request;
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_EQ(outcome.out, "");
  }
}

}  // namespace
}  // namespace patchlab
