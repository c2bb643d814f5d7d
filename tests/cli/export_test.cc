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
