#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ExportVerb : public Program {
 protected:
  ExportVerb() {
    write("ball.csv", ball_table());
    patchlab("fit ball.csv --surface sphere -o set.json");
  }
};

TEST_F(ExportVerb, WritesTriangles) {
  const Outcome outcome = patchlab("export set.json --format ply");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("ply\n"));
  EXPECT_EQ(patchlab("export set.json --format ply -o ball.ply").status, 0);
  EXPECT_EQ(text("ball.ply"), outcome.out);
  EXPECT_EQ(patchlab("export - --format ply", text("set.json")).out, outcome.out);
}

TEST_F(ExportVerb, KeepsThePatchSetBitForBit) {
  EXPECT_EQ(patchlab("export set.json --format patch_set").out, text("set.json"));
}

TEST_F(ExportVerb, WritesEveryFormatAndTheSameBytesAgain) {
  const std::string help = patchlab("help formats").out;
  for (const std::string format : {"patch_set", "csv", "footholds", "ply", "obj", "stl", "ros1-bag"}) {
    EXPECT_THAT(help, HasSubstr("  " + format + " ("));
    EXPECT_EQ(patchlab("export set.json --format " + format + " -o one").status, 0) << format;
    EXPECT_EQ(patchlab("export set.json --format " + format).out, text("one")) << format;
  }
  for (const std::string format : {"urdf", "mjcf", "ros2-yaml"}) {
    EXPECT_THAT(help, HasSubstr("  " + format + " (a folder)"));
    EXPECT_EQ(patchlab("export set.json --format " + format + " -o " + format).status, 0) << format;
    EXPECT_TRUE(std::filesystem::is_directory(at(format)));
  }
}

TEST_F(ExportVerb, LeavesAFolderThatIsThereAlone) {
  EXPECT_EQ(patchlab("export set.json --format urdf -o world").status, 0);
  const Outcome again = patchlab("export set.json --format mjcf -o world");
  EXPECT_EQ(again.status, 4);
  EXPECT_TRUE(again.one_sentence()) << again.err;
  EXPECT_FALSE(std::filesystem::exists(at("world/world.xml")));
  EXPECT_EQ(patchlab("export set.json --format urdf").status, 2);
}

TEST_F(ExportVerb, SaysWhatItWouldWriteAndWritesNothing) {
  const Outcome outcome = patchlab("export set.json --format mjcf --dry-run -o world");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("patches: patch-1"));
  EXPECT_THAT(outcome.out, HasSubstr("world.xml, "));
  EXPECT_FALSE(std::filesystem::exists(at("world")));
}

TEST_F(ExportVerb, NamesWhatIsLeftOutAndGoesOn) {
  const Outcome outcome = patchlab("export set.json --format footholds --foot-radius 1 -o feet.json");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("patch-1"));
  EXPECT_TRUE(json(text("feet.json"))["footholds"].empty());
}

TEST_F(ExportVerb, WritesAskedForPatchesAndCovariancesOnly) {
  const std::string options = "export set.json --format patch_set --covariance left_rot_trans ";
  const nlohmann::json set = json(patchlab(options + "--patch patch-1").out);
  EXPECT_TRUE(set["patches"][0]["pose"].contains("covariance_left_rot_trans"));
  EXPECT_FALSE(set["patches"][0]["pose"].contains("covariance_right_rot_trans"));
  EXPECT_EQ(patchlab(options + "--patch patch-9").status, 2);
  EXPECT_EQ(patchlab("export set.json --format ply --thickness 0").status, 2);
}

TEST_F(ExportVerb, RefusesWhatIsNoPatchSet) {
  for (const char* bad : {"{}", "{", "ply\n", "{\"format\": \"patchlab.patch_set\", \"version\": 9}"}) {
    const Outcome outcome = patchlab("export " + write("bad.json", bad) + " --format ply -o out.ply");
    EXPECT_EQ(outcome.status, 3) << bad;
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(at("out.ply")));
  }
}

TEST_F(ExportVerb, NamesTheFormatsWhereOneIsUnknown) {
  const Outcome outcome = patchlab("export set.json --format dance");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("ply"));
}

}  // namespace
}  // namespace patchlab
