#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Usage : public Program {};

TEST_F(Usage, SaysItsVersionAndHelpsOnStandardOutput) {
  EXPECT_THAT(patchlab("--version").out, StartsWith("patchlab "));
  for (const char* help : {"--help", "fit --help", "help", "help fit", "help noise", "help formats"}) {
    const Outcome outcome = patchlab(help);
    EXPECT_EQ(outcome.status, 0) << help;
    EXPECT_GT(outcome.out.size(), 100u) << help;
    EXPECT_EQ(outcome.err, "") << help;
  }
  EXPECT_THAT(patchlab("help noise").out, HasSubstr("kinect1"));
  EXPECT_THAT(patchlab("help formats").out, HasSubstr("ply"));
}

TEST_F(Usage, IsWrongWithStatusTwo) {
  write("ball.csv", ball_table());
  write("region.txt", "1\n2\n");
  for (const char* wrong : {"",
                            "dance",
                            "help dance",
                            "fit",
                            "fit ball.csv --surface cone",
                            "fit ball.csv --method guess",
                            "fit ball.csv --robust maybe",
                            "fit ball.csv --label 1 --region region.txt",
                            "fit ball.csv --label x",
                            "fit ball.csv --containment many",
                            "fit ball.csv --containment 1.5",
                            "fit ball.csv --containment 0",
                            "fit ball.csv --bounds paper --containment 1",
                            "fit ball.csv --method paper --containment 1",
                            "fit ball.csv --viewpoint 1,2",
                            "fit ball.csv --noise dance",
                            "fit ball.csv --noise isotropic:-1",
                            "fit ball.csv --label 1",
                            "fit - --region -",
                            "fit ball.csv --unknown",
                            "info",
                            "info a b",
                            "map",
                            "map dance",
                            "simulate x.json",
                            "export x.json",
                            "export x.json --format dance",
                            "replay",
                            "replay x --export ply",
                            "replay x --export dance=a",
                            "replay x -o - --json"}) {
    const Outcome outcome = patchlab(wrong);
    EXPECT_EQ(outcome.status, 2) << wrong << "\n" << outcome.err;
    EXPECT_NE(outcome.err, "") << wrong;
    EXPECT_EQ(outcome.out, "") << wrong;
  }
}

TEST_F(Usage, SaysWhyThePapersBoundsCannotContainAll) {
  write("ball.csv", ball_table());
  EXPECT_THAT(patchlab("fit ball.csv --bounds paper --containment 1").err, HasSubstr("infinite"));
}

TEST_F(Usage, EndsWithStatusThreeAndOneSentenceWhereAFileIsMissing) {
  for (const char* missing :
       {"info gone.pcd", "fit gone.pcd", "fit gone.pcd --region also_gone", "map chain gone.json",
        "simulate gone.json -o a.pcd", "export gone.json --format ply", "replay gone.patchlab"}) {
    const Outcome outcome = patchlab(missing);
    EXPECT_EQ(outcome.status, 3) << missing;
    EXPECT_TRUE(outcome.one_sentence()) << missing << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("gone")) << missing;
  }
}

}  // namespace
}  // namespace patchlab
