#include <cmath>

#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

class SimulateVerb : public Program {
 protected:
  SimulateVerb() {
    write("scene.json", R"({"format": "patchlab.scene", "version": 1,
      "camera": {"width": 160, "height": 120, "fx": 525, "fy": 525, "cx": 79.5, "cy": 59.5,
                 "pose": {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 1]}},
      "noise": "kinect1",
      "objects": [{"name": "ball", "patch": {"surface": "sphere", "boundary": "circle",
        "parameters": {"names": ["d", "kappa", "r_x", "r_y", "c_x", "c_y", "c_z"],
                       "values": [0.08, -10, 3.0, 0.0, 0.02, 0.0, 1.0]}}}]})");
  }
};

TEST_F(SimulateVerb, GivesTheSameScanForTheSameSeed) {
  EXPECT_EQ(patchlab("simulate scene.json --seed 3 -o a.pcd").status, 0);
  EXPECT_EQ(patchlab("simulate - --seed 3 -o b.pcd", text("scene.json")).status, 0);
  EXPECT_EQ(patchlab("simulate scene.json --seed 4 -o c.pcd").status, 0);
  EXPECT_EQ(text("a.pcd"), text("b.pcd"));
  EXPECT_NE(text("a.pcd"), text("c.pcd"));
  EXPECT_EQ(patchlab("simulate scene.json --seed 3 -o -").out, text("a.pcd"));
}

TEST_F(SimulateVerb, WritesTheTruthThatAFitOfTheScanFinds) {
  const Outcome outcome = patchlab("simulate scene.json -o scan.pcd --truth truth.json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json truth = json(text("truth.json"))["patches"][0];
  EXPECT_EQ(truth["id"], "ball");
  const nlohmann::json fit =
      json(patchlab("fit scan.pcd --label 1 --surface sphere --json").out)["patches"][0];
  const double kappa = fit["parameters"]["values"][1],
               sigma = std::sqrt(fit["covariance"][1][1].get<double>());
  EXPECT_NEAR(kappa, truth["parameters"]["values"][1].get<double>(), 4.0 * sigma);
  EXPECT_EQ(fit["provenance"]["region"], "label-1");
}

TEST_F(SimulateVerb, RefusesABadSceneAndABadNoise) {
  const Outcome bad =
      patchlab("simulate " + write("bad.json", "{\"format\": \"patchlab.scene\"}") + " -o a.pcd");
  EXPECT_EQ(bad.status, 3);
  EXPECT_TRUE(bad.one_sentence()) << bad.err;
  EXPECT_EQ(patchlab("simulate scene.json --noise dance -o a.pcd").status, 2);
  EXPECT_FALSE(std::filesystem::exists(at("a.pcd")));
}

TEST_F(SimulateVerb, FindsNoPointsOfALabelThatIsNotThere) {
  patchlab("simulate scene.json -o scan.pcd");
  const Outcome outcome = patchlab("fit scan.pcd --label 9");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("label 9"));
}

}  // namespace
}  // namespace patchlab
