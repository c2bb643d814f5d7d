// The JSON Schemas of assets/schema accept what the program prints.
#include "tests/cli/program.h"
#include "tests/support/json_schema.h"

namespace patchlab {
namespace {

using test::complaints;

class ProgramSchema : public Program {
 protected:
  nlohmann::json printed(const std::string& arguments) const {
    const Outcome outcome = patchlab(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json(outcome.out);
  }
};

TEST_F(ProgramSchema, AcceptsTheFitOfATable) {
  write("ball.csv", ball_table());
  const nlohmann::json set = printed("fit ball.csv --surface sphere --json");
  ASSERT_EQ(set["patches"].size(), 1u);
  EXPECT_EQ(complaints("patch_set", set), "");
}

TEST_F(ProgramSchema, AcceptsWhatAFileHolds) {
  write("ball.csv", ball_table());
  EXPECT_EQ(complaints("info", printed("info ball.csv --json")), "");
  const std::string pcd = PATCHLAB_SOURCE_DIR "/assets/rock_field.pcd";
  EXPECT_EQ(complaints("info", printed("info '" + pcd + "' --json")), "");
}

TEST_F(ProgramSchema, AcceptsAComposedChain) {
  write("chain.json", R"({"elements": [{"r": [0.1, -0.2, 0.3], "t": [0.5, 0.0, 0.2], "phi": 1, "covariance":
    [[1e-4,0,0,0,0,0],[0,1e-4,0,0,0,0],[0,0,1e-4,0,0,0],[0,0,0,1e-6,0,0],[0,0,0,0,1e-6,0],[0,0,0,0,0,1e-6]]}]})");
  EXPECT_EQ(complaints("chain", json(text("chain.json"))), "");
  EXPECT_EQ(complaints("chain.out", printed("map chain chain.json")), "");
}

}  // namespace
}  // namespace patchlab
