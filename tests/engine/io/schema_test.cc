// The JSON Schemas of assets/schema accept the contracts and what patchlab writes, and refuse what it
// refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/base/file.h"
#include "engine/io/patch_set.h"
#include "tests/engine/io/sample_set.h"
#include "tests/support/json_schema.h"

namespace patchlab {
namespace {

using nlohmann::json;
using test::complaints;
using test::read_json;

const std::filesystem::path top = PATCHLAB_SOURCE_DIR;

struct Contract {
  const char* file;
  const char* schema;
};
constexpr Contract contracts[] = {
    {"patch_set.json", "patch_set"}, {"scene.json", "scene"},
    {"info.json", "info"},           {"chain.json", "chain"},
    {"chain.out.json", "chain.out"}, {"region.json", "region"},
    {"joints.json", "joints"},       {"robot_patches.json", "robot_patches"},
};

class SchemaOfContract : public testing::TestWithParam<Contract> {
 protected:
  std::filesystem::path file() const { return top / "../shared/contracts" / GetParam().file; }
};

TEST_P(SchemaOfContract, AcceptsIt) {
  if (!std::filesystem::exists(file())) GTEST_SKIP() << "the contracts are not beside this checkout";
  EXPECT_EQ(complaints(GetParam().schema, read_json(file())), "");
}

TEST_P(SchemaOfContract, MissesEachOfItsRequiredMembers) {
  if (!std::filesystem::exists(file())) GTEST_SKIP() << "the contracts are not beside this checkout";
  const json required = test::schema_json(GetParam().schema)["required"];
  ASSERT_FALSE(required.empty());
  for (const std::string member : required) {
    json document = read_json(file());
    document.erase(member);
    EXPECT_NE(complaints(GetParam().schema, document), "") << member;
  }
}

INSTANTIATE_TEST_SUITE_P(Contracts, SchemaOfContract, testing::ValuesIn(contracts), [](const auto& contract) {
  std::string label = contract.param.schema;
  std::ranges::replace(label, '.', '_');
  return label;
});

void expect_journal(const std::filesystem::path& file) {
  std::istringstream lines{std::string(as_text(*read_file(file)))};
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(complaints("journal", json::parse(line)), "") << line;
  }
  EXPECT_GT(count, 1);
}

TEST(Schema, AcceptsEveryLineOfTheJournalContract) {
  const std::filesystem::path file = top / "../shared/contracts/journal.jsonl";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the contracts are not beside this checkout";
  expect_journal(file);
}

TEST(Schema, AcceptsEveryLineOfTheSampleJournal) { expect_journal(top / "assets/sample.patchlab"); }

TEST(Schema, AcceptsEveryLineOfTheJournalOfTheMap) { expect_journal(top / "assets/figures/map.patchlab"); }

TEST(Schema, RefusesAJournalLineThatDoesNothingKnown) {
  EXPECT_NE(complaints("journal", {{"do", "dance"}}), "");
  EXPECT_NE(complaints("journal", {{"do", "rename"}, {"target", "patch-1"}}), "");
  EXPECT_NE(complaints("journal", {{"do", "select"}, {"region", "r"}, {"scan", "s"}, {"mode", "set"}}), "");
  EXPECT_NE(complaints("journal", {{"do", "undo"}, {"twice", true}}), "");
  EXPECT_NE(complaints("journal", {{"do", "merge"}, {"map", "m"}, {"view", "s"}, {"gate", 1.0}}), "");
}

TEST(Schema, AcceptsThePatchSetsThatAreWritten) {
  EXPECT_EQ(complaints("patch_set", json::parse(*write_patch_set(test::sample_set()))), "");
  EXPECT_EQ(complaints("patch_set", json::parse(*write_patch_set(test::designed_set()))), "");
  EXPECT_EQ(complaints("patch_set", json::parse(*write_patch_set({}))), "");
}

TEST(Schema, HoldsEachPatchToTheParametersOfItsType) {
  json document = json::parse(*write_patch_set(test::sample_set()));
  const json patches = document["patches"];
  const auto complaints_of = [&](const json& patch) {
    document["patches"] = json::array({patch});
    return complaints("patch_set", document);
  };
  for (const json& patch : patches) {
    json other_name = patch, one_more = patch, other_pair = patch;
    other_name["parameters"]["names"][0] = "c_x";
    one_more["parameters"]["values"].push_back(0.0);
    other_pair["boundary"] = patch["boundary"] == "circle" ? "rectangle" : "circle";
    EXPECT_EQ(complaints_of(patch), "");
    EXPECT_NE(complaints_of(other_name), "");
    EXPECT_NE(complaints_of(one_more), "");
    EXPECT_NE(complaints_of(other_pair), "");
  }
}

TEST(Schema, AcceptsTheSampleScene) {
  EXPECT_EQ(complaints("scene", read_json(top / "assets/rock_field.scene.json")), "");
  EXPECT_EQ(complaints("patch_set", read_json(top / "assets/rock_field.truth.json")), "");
}

}  // namespace
}  // namespace patchlab
