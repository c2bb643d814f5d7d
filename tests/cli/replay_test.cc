#include "engine/base/file.h"
#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

class ReplayVerb : public Program {
 protected:
  ReplayVerb() {
    std::filesystem::create_directory(at("work"));
    write("work/ball.csv", ball_table());
    write("work/ball.patchlab", journal(sha256(ball_table())));
  }

  // A lasso round the ball as a camera at the origin that looks along +z sees it, and a fit.
  static std::string journal(const std::string& hash) {
    return R"({"format": "patchlab.journal", "version": 1, "program": "patchlab 0.1.0"}
{"do": "open_scan", "id": "scan-1", "file": "ball.csv", "sha256": ")" +
           hash + R"(", "unit": "m"}
{"do": "select", "region": "region-1", "scan": "scan-1", "mode": "set", "polygon": [[440, 200], [840, 200], [840, 600], [440, 600]], "camera": {"position": [0, 0, 0], "quaternion_xyzw": [1, 0, 0, 0], "fov_y": 0.4, "near": 0.01, "projection": "perspective", "viewport": [1280, 800]}, "visible_only": false}
{"do": "fit", "patch": "patch-1", "region": "region-1", "options": {"surface": "sphere", "boundary": "auto", "method": "calibrated", "robust": false}}
{"do": "rename", "target": "patch-1", "name": "ball"}
)";
  }
};

TEST_F(ReplayVerb, MakesTheSamePatchSetEveryTimeFromAnyFolder) {
  const Outcome first = patchlab("replay work/ball.patchlab -o -");
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(patchlab("replay work/ball.patchlab --json").out, first.out);
  EXPECT_EQ(patchlab("replay '" + at("work/ball.patchlab").string() + "' -o set.json").status, 0);
  EXPECT_EQ(text("set.json"), first.out);
  const nlohmann::json set = json(first.out);
  EXPECT_EQ(set["patches"][0]["name"], "ball");
  EXPECT_EQ(set["patches"][0]["provenance"]["journal"], "ball.patchlab");
  EXPECT_EQ(set["sources"][0]["file"], "ball.csv");
  EXPECT_GT(set["patches"][0]["fit"]["points"], 150);
}

TEST_F(ReplayVerb, ExportsInAsManyFormatsAsAsked) {
  const Outcome outcome =
      patchlab("replay work/ball.patchlab -o set.json --export ply=ball.ply --export patch_set=again.json");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(text("ball.ply"), testing::StartsWith("ply\n"));
  EXPECT_EQ(text("again.json"), text("set.json"));
}

TEST_F(ReplayVerb, PrintsATableOfEachPatchWithoutOptions) {
  const Outcome outcome = patchlab("replay work/ball.patchlab");
  EXPECT_THAT(outcome.out, HasSubstr("ball: sphere, circle"));
}

TEST_F(ReplayVerb, RefusesAChangedScanUnlessItIsNamed) {
  write("work/ball.patchlab", journal("5f0c"));
  const Outcome refused = patchlab("replay work/ball.patchlab -o set.json");
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(refused.one_sentence()) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("line 2"));
  EXPECT_FALSE(std::filesystem::exists(at("set.json")));
  EXPECT_EQ(patchlab("replay work/ball.patchlab --on work/ball.csv -o set.json").status, 0);
}

TEST_F(ReplayVerb, DropsATornLastLineAndNumbersABadOneBefore) {
  const std::string whole = patchlab("replay work/ball.patchlab -o -").out;
  write("work/ball.patchlab", journal(sha256(ball_table())) + "{\"do\": \"del");
  EXPECT_EQ(patchlab("replay work/ball.patchlab -o -").out, whole);
  write("work/ball.patchlab", journal(sha256(ball_table())) + "{\"do\": \"del\n{\"do\": \"undo\"}\n");
  const Outcome bad = patchlab("replay work/ball.patchlab -o -");
  EXPECT_EQ(bad.status, 3);
  EXPECT_TRUE(bad.one_sentence()) << bad.err;
  EXPECT_THAT(bad.err, HasSubstr("ball.patchlab: line 6"));
}

TEST_F(ReplayVerb, EndsWithStatusThreeForACommandThatCannotBe) {
  write("work/ball.patchlab",
        journal(sha256(ball_table())) + "{\"do\": \"delete\", \"target\": \"patch-7\"}\n");
  const Outcome outcome = patchlab("replay work/ball.patchlab");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("line 6: There is no scan, region, patch, map or robot 'patch-7'"));
}

TEST_F(ReplayVerb, UndoesAndRedoes) {
  write("work/ball.patchlab",
        journal(sha256(ball_table())) + "{\"do\": \"undo\"}\n{\"do\": \"undo\"}\n{\"do\": \"redo\"}\n");
  const nlohmann::json set = json(patchlab("replay work/ball.patchlab --json").out);
  EXPECT_EQ(set["patches"][0]["name"], "patch-1");
}

}  // namespace
}  // namespace patchlab
