#include <fstream>

#include "tests/cli/program.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Every number of `actual` within 1e-12 of `expected`, everything else equal.
void expect_near(const nlohmann::json& actual, const nlohmann::json& expected, const std::string& place) {
  if (expected.is_number_float()) {
    EXPECT_NEAR(actual.get<double>(), expected.get<double>(), 1e-12) << place;
  } else if (expected.is_structured()) {
    ASSERT_EQ(actual.size(), expected.size()) << place;
    for (const auto& [key, value] : expected.items()) {
      expect_near(expected.is_array() ? actual[std::stoul(key)] : actual[key], value, place + "/" + key);
    }
  } else {
    EXPECT_EQ(actual, expected) << place;
  }
}

class MapChain : public Program {};

TEST_F(MapChain, ComposesTheContractsChain) {
  const std::filesystem::path chain = shared("contracts/chain.json");
  if (chain.empty()) GTEST_SKIP() << "no contracts beside this checkout";
  const nlohmann::json expected = json(contents(shared("contracts/chain.out.json")));
  const Outcome outcome = patchlab("map chain '" + chain.string() + "'");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  expect_near(json(outcome.out), expected, "");
  EXPECT_EQ(patchlab("map chain -", contents(chain)).out, outcome.out);
  EXPECT_EQ(patchlab("map chain --json '" + chain.string() + "'").out, outcome.out);
}

TEST_F(MapChain, GivesAnExactPoseBackAsItIs) {
  const nlohmann::json pose =
      json(patchlab("map chain -", R"({"elements": [{"r": [0.1, 0, 0], "t": [1, 2, 3]}]})").out);
  EXPECT_NEAR(pose["r"][0].get<double>(), 0.1, 1e-15);
  EXPECT_EQ(pose["t"], (nlohmann::json{1.0, 2.0, 3.0}));
  EXPECT_EQ(pose["covariance"][3][3], 0.0);
}

TEST_F(MapChain, RefusesABadChainInOneSentenceThatNamesTheMember) {
  std::string cov = "[";
  for (int i = 0; i < 6; ++i)
    cov += std::string(i == 0 ? "" : ",") + "[0,0,0,0,0," + (i == 5 ? "-1" : "0") + "]";
  cov += "]";
  const std::pair<std::string, const char*> bad[] = {
      {"{", "JSON"},
      {"[]", "object"},
      {"{}", "elements"},
      {R"({"elements": []})", "elements"},
      {R"({"elements": [{"r": [0, 0], "t": [0, 0, 0]}]})", "elements[0].r"},
      {R"({"elements": [{"r": [0, 0, 0], "t": [0, 0, 0], "phi": 2}]})", "elements[0].phi must be 1 or -1"},
      {R"({"elements": [{"r": [0, 0, 0], "t": [0, 0, 0], "phi": 1, "sigma": 1}]})", "sigma"},
      {R"({"elements": [{"r": [0, 0, 0], "t": [0, 0, 0], "covariance": )" + cov + "}]}",
       "positive semi-definite"}};
  for (const auto& [text, says] : bad) {
    const Outcome outcome = patchlab("map chain " + write("chain.json", text));
    EXPECT_EQ(outcome.status, 3) << text;
    EXPECT_TRUE(outcome.one_sentence()) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("chain.json"));
    EXPECT_THAT(outcome.err, HasSubstr(says));
  }
}

}  // namespace
}  // namespace patchlab
