#include <numbers>

#include "engine/io/patch_set.h"
#include "engine/map/queries.h"
#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

PatchRecord plate(const std::string& id, const std::string& frame, const Vector3d& at, double tilt,
                  double radius = 0.05) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::circle);
  const Eigen::VectorXd d = Eigen::VectorXd::Constant(1, radius);
  const PatchMatrix cov = 1e-6 * PatchMatrix::Identity(type.size(), type.size());
  PatchRecord record;
  record.id = id;
  record.frame_id = frame;
  record.patch = make_patch(type, {type.boundary, d}, Eigen::VectorXd(), exp_map({tilt, 0.0, 0.0}), at, cov);
  return record;
}

class MapQuery : public Program {
 protected:
  MapQuery() {
    PatchSet ground, robot;
    ground.patches = {plate("step", "body", {0.0, 0.0, 0.0}, 0.0),
                      plate("slope", "body", {0.3, 0.4, 0.0}, 0.2)};
    robot.patches = {plate("sole", "body", {0.0, 0.0, 0.02}, std::numbers::pi, 0.04)};
    ground_ = write("ground.json", *write_patch_set(ground));
    robot_ = write("robot.json", *write_patch_set(robot));
  }
  nlohmann::json ask(const std::string& question) const {
    const Outcome outcome = patchlab("map query " + ground_ + " " + robot_ + " --json " + question);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json(outcome.out)["answers"][0];
  }
  std::string ground_, robot_;
};

TEST_F(MapQuery, MeasuresBetweenTwoPatches) {
  const nlohmann::json answer = ask("--between step slope");
  EXPECT_NEAR(answer["distance"]["value"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(answer["distance"]["sigma"].get<double>(), std::sqrt(2.0) * 1e-3, 1e-9);
  EXPECT_NEAR(answer["angle"]["value"].get<double>(), 0.2, 1e-12);
}

TEST_F(MapQuery, TellsATiltAndHowProbablyItIsTooMuch) {
  const nlohmann::json at_the_limit = ask("--tilt slope --limit 11.459155902616466");
  EXPECT_NEAR(at_the_limit["tilt"]["value"].get<double>(), 0.2, 1e-12);
  EXPECT_NEAR(at_the_limit["probability"].get<double>(), 0.5, 0.01);
  EXPECT_LT(ask("--tilt slope --limit 12")["probability"].get<double>(), 1e-6);
  EXPECT_NEAR(ask("--tilt slope --up 0,0,-1")["tilt"]["value"].get<double>(), std::numbers::pi - 0.2, 1e-12);
}

TEST_F(MapQuery, FitsAFootOfTheRobotOnTheGround) {
  const nlohmann::json answer = ask("--foot sole step");
  EXPECT_NEAR(answer["gap"]["value"].get<double>(), 0.02, 1e-6);
  EXPECT_GT(answer["gap"]["sigma"].get<double>(), 1e-3);
  EXPECT_NEAR(answer["share"].get<double>(), 1.0, 0.02);
}

TEST_F(MapQuery, FindsPatchesAroundAPointNearestFirst) {
  const nlohmann::json near = ask("--near 0,0,0.019 --radius 0.1")["patches"];
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[0]["id"], "sole");
  EXPECT_EQ(near[1]["id"], "step");
}

TEST_F(MapQuery, SaysItInWordsToo) {
  const Outcome outcome = patchlab("map query " + ground_ + " --between step slope --tilt slope");
  EXPECT_THAT(outcome.out, HasSubstr("step to slope: centres 500.00 +- 1.41 mm apart, normals 11.459 +- "));
  EXPECT_THAT(outcome.out, HasSubstr("slope: tilt 11.459 +- "));
}

TEST_F(MapQuery, SaysWherePatchesShareErrors) {
  PatchSet legs;
  legs.patches = {plate("left", "body", {0.0, 0.1, 0.0}, 0.0), plate("right", "body", {0.0, -0.1, 0.0}, 0.0)};
  legs.unknown["correlations"] = "patches_share_errors";
  const std::string file = write("legs.json", *write_patch_set(legs));
  const Outcome between = patchlab("map query " + file + " --between left right");
  EXPECT_EQ(between.status, 0);
  EXPECT_THAT(between.err, HasSubstr("legs.json: its patches share errors"));
  EXPECT_EQ(patchlab("map query " + file + " --tilt left").err, "");
}

TEST_F(MapQuery, RefusesWhatIsNotClear) {
  PatchSet far;
  far.patches = {plate("far", "camera", {0.0, 0.0, 0.0}, 0.0)};
  const std::string camera = write("camera.json", *write_patch_set(far));
  const std::pair<std::string, const char*> bad[] = {
      {ground_, "Nothing is asked"},
      {ground_ + " --tilt none", "there are: step slope"},
      {ground_ + " " + ground_ + " --tilt step", "it is clear which"},
      {ground_ + " " + camera + " --between step far", "in \"camera\""},
      {ground_ + " " + camera + " --near 0,0,0", "in \"camera\""},
      {ground_ + " --tilt step --up 0,0,0", "no direction"}};
  for (const auto& [question, says] : bad) {
    const Outcome outcome = patchlab("map query " + question);
    EXPECT_EQ(outcome.status, 2) << question;
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
  }
}

}  // namespace
}  // namespace patchlab
