// The patch set against the example that other programs rely on, where it lies beside this checkout.
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/base/file.h"
#include "engine/io/patch_set.h"
#include "tests/engine/io/sample_set.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

class PatchSetContract : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file =
        std::filesystem::path(PATCHLAB_SOURCE_DIR) / "../shared/contracts/patch_set.json";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "the contracts are not beside this checkout";
    text_ = as_text(*read_file(file));
  }

  std::string text_;
};

std::vector<std::string> members(const ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) names.push_back(key);
  return names;
}

TEST_F(PatchSetContract, IsRead) {
  const Result<PatchSet> set = read_patch_set(text_, "patch_set.json");
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->patches.size(), 2u);
  const PatchRecord& ball = set->patches[0];
  EXPECT_EQ(ball.name, "ball top");
  EXPECT_EQ(ball.patch.type->surface, SurfaceType::sphere);
  EXPECT_EQ(ball.patch.parameters[1], -12.4);
  EXPECT_EQ((*ball.patch.covariance_local)(2, 2), 9e-4);
  EXPECT_EQ(ball.fit->outliers, 3u);
  EXPECT_EQ(ball.provenance["region"], "region-1");
  EXPECT_FALSE(set->patches[1].patch.covariance);
}

TEST_F(PatchSetContract, HoldsNoMemberThatIsUnknown) {
  const Result<PatchSet> set = read_patch_set(text_, "patch_set.json");
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_TRUE(set->unknown.empty()) << set->unknown;
  EXPECT_TRUE(set->sources[0].unknown.empty()) << set->sources[0].unknown;
  for (const PatchRecord& record : set->patches) EXPECT_TRUE(record.unknown.empty()) << record.unknown;
}

TEST_F(PatchSetContract, HasTheMembersThatAreWrittenInTheirOrder) {
  const ordered_json expected = ordered_json::parse(text_);
  const ordered_json written = ordered_json::parse(*write_patch_set(test::sample_set()));
  EXPECT_EQ(members(written), members(expected));
  EXPECT_EQ(members(written["sources"][0]), members(expected["sources"][0]));
  const ordered_json &patch = written["patches"][0], &expected_patch = expected["patches"][0];
  EXPECT_EQ(members(patch), members(expected_patch));
  for (const char* nested : {"parameters", "covariance_local", "pose", "fit"}) {
    EXPECT_EQ(members(patch[nested]), members(expected_patch[nested])) << nested;
  }
}

}  // namespace
}  // namespace patchlab
