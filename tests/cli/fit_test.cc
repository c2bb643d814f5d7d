#include <sys/stat.h>

#include <cmath>

#include "engine/io/patch_set.h"
#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

class FitVerb : public Program {
 protected:
  FitVerb() { write("ball.csv", ball_table()); }

  nlohmann::json patch(const std::string& arguments, const std::string& input = {}) const {
    const Outcome outcome = patchlab("fit " + arguments + " --json", input);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json(outcome.out)["patches"][0];
  }
};

TEST_F(FitVerb, FindsTheBallWithinItsUncertainty) {
  const nlohmann::json ball = patch("ball.csv --surface sphere");
  EXPECT_EQ(ball["surface"], "sphere");
  const double kappa = ball["parameters"]["values"][1], sigma = std::sqrt(double(ball["covariance"][1][1]));
  EXPECT_NEAR(std::abs(kappa), 10.0, 4.0 * sigma);
  EXPECT_LT(sigma, 1.0);
  EXPECT_EQ(ball["fit"]["accepted"], true);
  EXPECT_EQ(ball["frame_id"], "sensor");
}

TEST_F(FitVerb, WritesAPatchSetThatReadsBack) {
  EXPECT_EQ(patchlab("fit ball.csv -o set.json").status, 0);
  const Result<PatchSet> set = read_patch_set(text("set.json"), "set.json");
  ASSERT_TRUE(set.ok()) << set.error().message;
  EXPECT_EQ(set->sources.at(0).file, "ball.csv");
  EXPECT_EQ(set->sources.at(0).noise, "from_file");
  EXPECT_EQ(set->sources.at(0).sha256.size(), 64u);
}

TEST_F(FitVerb, NamesThePatchAsAsked) {
  EXPECT_EQ(patch("ball.csv --id left-mug")["id"], "left-mug");
  EXPECT_EQ(patch("ball.csv")["id"], "patch-1");
}

TEST_F(FitVerb, GivesTheSameBytesEveryTimeAndOnEveryWayOut) {
  const std::string set = patchlab("fit ball.csv --robust on --json").out;
  EXPECT_EQ(patchlab("fit ball.csv --robust on --json").out, set);
  EXPECT_EQ(patchlab("fit ball.csv --robust -o -").out, set);
  patchlab("fit ball.csv --robust on -o set.json");
  EXPECT_EQ(text("set.json"), set);
}

TEST_F(FitVerb, ReadsStandardInput) {
  nlohmann::json from_file = patch("ball.csv"), from_input = patch("-", ball_table());
  EXPECT_EQ(from_input["parameters"], from_file["parameters"]);
}

TEST_F(FitVerb, PrintsATableWithUnitsAndTheVerdict) {
  const std::string table = patchlab("fit ball.csv --surface sphere").out;
  for (const char* part :
       {"sphere, circle", "ball.csv", "±", "1/m", "radius", "chi2 / dof", "verdict", "outliers"}) {
    EXPECT_THAT(table, HasSubstr(part));
  }
}

TEST_F(FitVerb, TellsItsStepsOnStandardError) {
  const Outcome outcome = patchlab("fit ball.csv --explain --json");
  EXPECT_GT(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 3);
  json(outcome.out);
}

TEST_F(FitVerb, TakesARegionAsLinesOrAsJson) {
  std::string lines, list;
  for (int i = 0; i < 120; ++i) {
    lines += std::to_string(i) + "\n";
    list += (i == 0 ? "" : ",") + std::to_string(i);
  }
  write("region.txt", lines);
  write("region.json", "{\"indices\": [" + list + "]}");
  const nlohmann::json from_lines = patch("ball.csv --region region.txt");
  EXPECT_EQ(from_lines["fit"]["points"], 120);
  EXPECT_EQ(patch("ball.csv --region region.json")["parameters"], from_lines["parameters"]);
  EXPECT_EQ(patch("ball.csv --region -", lines)["parameters"], from_lines["parameters"]);
  EXPECT_EQ(from_lines["provenance"]["region"], "region.txt");
}

TEST_F(FitVerb, RefusesABadRegionInOneSentence) {
  const std::pair<const char*, const char*> bad[] = {{"1\n2\nthree\n", "line 3: 'three'"},
                                                     {"1\n-2\n", "line 2"},
                                                     {"1\n2.5\n", "line 2"},
                                                     {"0\n200\n", "point 200"},
                                                     {"{\"indices\": [1, -2]}", "indices[1]"},
                                                     {"{\"indices\": [1, 2", "JSON"},
                                                     {"{\"points\": [1, 2]}", "points"},
                                                     {"1\n2\n", "Too few points"}};
  for (const auto& [region, says] : bad) {
    write("region", region);
    const Outcome outcome = patchlab("fit ball.csv --region region");
    EXPECT_EQ(outcome.status, 3) << region;
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
  }
}

TEST_F(FitVerb, RefusesPointsThatDetermineNoPatch) {
  std::string flat = "x,y,z,cxx,cxy,cxz,cyy,cyz,czz\n";
  for (int i = 0; i < 20; ++i)
    flat += std::to_string(i) + "," + std::to_string(i % 5) + ",1,1e-6,0,0,1e-6,0,-1e-6\n";
  const std::pair<std::string, const char*> bad[] = {{line_table(50), "line"},
                                                     {line_table(3), "Too few"},
                                                     {flat, "point 0 (counted from 0) is not positive"}};
  for (const auto& [table, says] : bad) {
    write("bad.csv", table);
    const Outcome outcome =
        patchlab("fit bad.csv --noise " + std::string(table == flat ? "from_file" : "isotropic:0.001"));
    EXPECT_EQ(outcome.status, 3);
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_THAT(outcome.err, HasSubstr("bad.csv"));
  }
}

TEST_F(FitVerb, EndsWithStatusOneForAPoorFitOnlyWhereThatIsAsked) {
  EXPECT_EQ(patchlab("fit ball.csv --surface plane").status, 0);
  const Outcome refused = patchlab("fit ball.csv --surface plane --require-accepted --json");
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(json(refused.out)["patches"][0]["fit"]["accepted"], false);
  EXPECT_FALSE(json(refused.out)["patches"][0]["fit"]["reasons"].empty());
  EXPECT_EQ(patchlab("fit ball.csv --surface sphere --require-accepted").status, 0);
}

TEST_F(FitVerb, TurnsTheNormalTowardsTheViewpoint) {
  const auto curvature = [&](const std::string& viewpoint) {
    return patch("ball.csv --surface sphere --viewpoint " + viewpoint)["parameters"]["values"][1]
        .get<double>();
  };
  EXPECT_LT(curvature("0,0,-0.5"), 0.0) << "seen from outside the ball is convex";
  EXPECT_GT(curvature("-0.01,0,1"), 0.0) << "seen from its centre it is concave";
  const nlohmann::json moved = json(patchlab("fit ball.csv --viewpoint -1,0,-0.5 --json").out);
  EXPECT_EQ(moved["sources"][0]["viewpoint"]["position"], (nlohmann::json{-1.0, 0.0, -0.5}));
  EXPECT_EQ(moved["sources"][0]["viewpoint"]["stated"], true);
  EXPECT_EQ(moved["patches"][0]["frame_id"], "world");
}

TEST_F(FitVerb, SaysWhichNoiseItAssumes) {
  std::string bare = ball_table();
  write(
      "bare.csv", "x,y,z\n" + [&] {
        std::string rows;
        for (std::size_t at = bare.find('\n') + 1; at < bare.size(); at = bare.find('\n', at) + 1) {
          rows += bare.substr(at, bare.find(",1e-6", at) - at) + "\n";
        }
        return rows;
      }());
  EXPECT_THAT(patchlab("fit bare.csv").err, HasSubstr("is assumed"));
  EXPECT_EQ(patchlab("fit bare.csv --noise isotropic:0.001").err.find("is assumed"), std::string::npos);
}

TEST_F(FitVerb, EndsWithStatusFourWhereItCannotWrite) {
  for (const char* file : {"/nonexistent/set.json", "/dev/full", "."}) {
    const Outcome outcome = patchlab("fit ball.csv -o " + std::string(file));
    EXPECT_EQ(outcome.status, 4) << file;
    EXPECT_THAT(outcome.err, HasSubstr(file));
  }
  struct stat full {};
  ASSERT_EQ(::stat("/dev/full", &full), 0);
  EXPECT_TRUE(S_ISCHR(full.st_mode)) << "a device is not replaced by a file";
  EXPECT_EQ(patchlab("fit ball.csv --json >/dev/full").status, 4);
}

TEST_F(FitVerb, LeavesNothingBehindWhenItFails) {
  patchlab("fit ball.csv --surface plane -o set.json");
  const std::string before = text("set.json");
  EXPECT_EQ(patchlab("fit ball.csv --region gone -o set.json").status, 3);
  EXPECT_EQ(text("set.json"), before);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(at("")))
    files += entry.path().string().find("set.json") != std::string::npos;
  EXPECT_EQ(files, 1);
}

}  // namespace
}  // namespace patchlab
