// What a reader of patch sets must refuse: each row is one damage and what the message says of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/patch_set.h"
#include "tests/engine/io/sample_set.h"

namespace patchlab {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct Fault {
  const char* what;
  const char* place;        // JSON pointer of the member that is replaced
  const char* replacement;  // JSON; empty: the member is removed
  const char* says;
};

// The first patch of the sample is an elliptic paraboloid: ten parameters.
constexpr Fault faults[] = {
    {"OtherFormat", "/format", R"("patchlab.scene")", "format is not \"patchlab.patch_set\""},
    {"NoVersion", "/version", "", "lacks the member \"version\""},
    {"HigherVersion", "/version", "2", "version 2 of patchlab.patch_set is newer than this program"},
    {"VersionZero", "/version", "0", "version is below 1"},
    {"NoPatches", "/patches", "", "lacks the member \"patches\""},
    {"PatchesNoArray", "/patches", "7", "patches is 7 where an array is expected"},
    {"PatchNoObject", "/patches/0", "7", "patches[0] is 7 where an object is expected"},
    {"OtherUnits", "/units/length", R"("mm")", "metre"},
    {"OtherCorrelations", "/correlations", R"("full")", "\"full\""},
    {"EmptyId", "/patches/0/id", R"("")", "patches[0].id is empty"},
    {"IdTwice", "/patches/1/id", R"("elliptic_paraboloid_concave")", "patches[1].id is taken"},
    {"NoFrame", "/patches/0/frame_id", "", "lacks the member \"frame_id\""},
    {"UnknownSurface", "/patches/0/surface", R"("torus")", "\"torus\" is not a surface"},
    {"UnknownBoundary", "/patches/0/boundary", R"("star")", "\"star\" is not a boundary"},
    {"PairNotInTableI", "/patches/0/boundary", R"("convex_quad")", "none of the ten patch types"},
    {"OtherNames", "/patches/0/parameters/names/0", R"("d_1")", "parameters.names differ"},
    {"NoValues", "/patches/0/parameters/values", "", "parameters lacks the member \"values\""},
    {"TooFewValues", "/patches/0/parameters/values/9", "",
     "parameters.values has 9 entries, 10 are expected"},
    {"ValueNoNumber", "/patches/0/parameters/values/0", R"("wide")", "values[0] is \"wide\" where a number"},
    {"ValueNull", "/patches/0/parameters/values/0", "null", "values[0] is null where a number"},
    {"NoPatch", "/patches/0/parameters/values/0", "-0.1", "not positive"},
    {"TooFewRows", "/patches/0/covariance/3", "", "covariance has 9 rows, 10 are expected"},
    {"ShortRow", "/patches/0/covariance/3/0", "", "covariance[3] has 9 entries, 10 are expected"},
    {"NegativeVariance", "/patches/0/covariance/0/0", "-1", "negative variance"},
    {"NotSymmetric", "/patches/0/covariance_local/values/0/1", "1", "not symmetric"},
    {"OtherLocalNames", "/patches/0/covariance_local/names/0", R"("d_1")", "covariance_local.names differ"},
    {"UnknownMethod", "/patches/0/fit/method", R"("guess")", "\"guess\" is not a fit method"},
    {"NegativeCount", "/patches/0/fit/points", "-1", "fit.points is -1 where a whole number"},
    {"NoCoverage", "/patches/0/fit/coverage", "", "fit lacks the member \"coverage\""},
    {"ReasonNoSentence", "/patches/0/fit/reasons/0", "7", "fit.reasons[0] is 7 where an object"},
    {"NoRotation", "/sources/0/viewpoint/quaternion_xyzw/3", "0.7", "is not of length 1"},
    {"SourceWithoutViewpoint", "/sources/0/viewpoint", "", "sources[0] lacks the member \"viewpoint\""},
};

json sound_set() {
  static const json sound = json::parse(*write_patch_set(test::sample_set()));
  return sound;
}

class PatchSetFault : public testing::TestWithParam<Fault> {};

TEST_P(PatchSetFault, IsRefusedByNameOfFileAndPlace) {
  json object = sound_set();
  const json::json_pointer place(GetParam().place);
  ASSERT_TRUE(object.contains(place));
  const std::string replacement = GetParam().replacement;
  if (!replacement.empty()) {
    object[place] = json::parse(replacement);
  } else if (json& parent = object[place.parent_pointer()]; parent.is_array()) {
    parent.erase(std::stoul(place.back()));
  } else {
    parent.erase(place.back());
  }
  const Result<PatchSet> set = read_patch_set(object.dump(), "mug.json");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, ErrorCode::unreadable);
  EXPECT_THAT(set.error().message, testing::StartsWith("mug.json: "));
  EXPECT_THAT(set.error().message, testing::EndsWith("."));
  EXPECT_THAT(set.error().message, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(Rows, PatchSetFault, testing::ValuesIn(faults),
                         [](const auto& fault) { return fault.param.what; });

TEST(PatchSetFaults, NameThePatch) {
  json object = sound_set();
  object["patches"][4]["parameters"].erase("values");
  const Result<PatchSet> set = read_patch_set(object.dump(), "mug.json");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().message, "mug.json: patch \"" + test::sample_set().patches[4].id +
                                     "\": parameters lacks the member \"values\".");
}

TEST(PatchSetFaults, DoNotIncludeAHigherMinorVersion) {
  json object = sound_set();
  object["version"] = 1.5;
  EXPECT_TRUE(read_patch_set(object.dump(), "mug.json"));
}

TEST(PatchSetFaults, AreFoundInATextThatStopsAnywhere) {
  const std::string text = *write_patch_set(test::designed_set());
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    EXPECT_FALSE(read_patch_set(text.substr(0, length), "cut.json")) << length;
  }
}

}  // namespace
}  // namespace patchlab
