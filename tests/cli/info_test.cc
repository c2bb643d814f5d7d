#include <fstream>
#include <set>

#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

class Info : public Program {};

TEST_F(Info, PrintsEveryMemberOfTheContract) {
  const std::filesystem::path contract = shared("contracts/info.json");
  if (contract.empty()) GTEST_SKIP() << "no contracts beside this checkout";
  write("line.csv", line_table(7));
  const auto names = [](const nlohmann::json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.insert(key);
    return keys;
  };
  std::ifstream stream(contract);
  const nlohmann::json expected = json({std::istreambuf_iterator<char>(stream), {}});
  const nlohmann::json info = json(patchlab("info line.csv --json").out);
  EXPECT_THAT(names(info), IsSupersetOf(names(expected)));
  EXPECT_THAT(names(info["viewpoint"]), IsSupersetOf(names(expected["viewpoint"])));
  EXPECT_THAT(names(info["fields"][0]), IsSupersetOf(names(expected["fields"][0])));
  EXPECT_THAT(names(info["bounds"]), IsSupersetOf(names(expected["bounds"])));
}

TEST_F(Info, CountsPointsAndBounds) {
  write("line.csv", line_table(7));
  const nlohmann::json info = json(patchlab("info line.csv --json").out);
  EXPECT_EQ(info["points"], 7);
  EXPECT_EQ(info["finite_points"], 7);
  EXPECT_EQ(info["organized"], false);
  EXPECT_EQ(info["covariance"], false);
  EXPECT_EQ(info["bounds"]["max"], (nlohmann::json{6.0, 0.0, 0.0}));
  EXPECT_EQ(info["file"], "line.csv");
}

TEST_F(Info, ReadsStandardInput) {
  write("ball.csv", ball_table());
  nlohmann::json from_file = json(patchlab("info ball.csv --json").out);
  nlohmann::json from_input = json(patchlab("info - --json", ball_table()).out);
  EXPECT_GT(from_file["memory_bytes"], 200 * 13) << "of the points alone";
  EXPECT_TRUE(from_input["memory_bytes"].is_null()) << "nobody knows how much will come";
  for (const char* member : {"file", "memory_bytes"}) {
    from_file.erase(member);
    from_input.erase(member);
  }
  EXPECT_EQ(from_input, from_file);
}

TEST_F(Info, IsReadableWithoutJson) {
  write("ball.csv", ball_table());
  const std::string text = patchlab("info ball.csv").out;
  EXPECT_THAT(text, HasSubstr("points      200, 200 finite\n"));
  EXPECT_THAT(text, HasSubstr("covariance  yes\n"));
}

TEST_F(Info, RefusesAMalformedFileInOneSentenceThatNamesIt) {
  write("bad.csv", "x,y,z\n1,2,three\n");
  const Outcome outcome = patchlab("info bad.csv");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("bad.csv"));
}

TEST_F(Info, ReadsOrRefusesEveryBadInputInOneSentence) {
  const std::filesystem::path folder = shared("bad_inputs");
  if (folder.empty()) GTEST_SKIP() << "no malformed files beside this checkout";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().string();
    if (name.find('\'') != std::string::npos) continue;  // the shell of the test cannot quote it
    const Outcome outcome = patchlab("info --json '" + name + "'");
    if (outcome.status == 0) {
      json(outcome.out);
    } else {
      EXPECT_EQ(outcome.status, 3) << entry.path() << outcome.err;
      EXPECT_TRUE(outcome.one_sentence()) << entry.path() << outcome.err;
    }
  }
}

TEST_F(Info, EndsWithStatusFourWhereStandardOutputIsFull) {
  write("ball.csv", ball_table());
  EXPECT_EQ(patchlab("info ball.csv >/dev/full").status, 4);
}

}  // namespace
}  // namespace patchlab
