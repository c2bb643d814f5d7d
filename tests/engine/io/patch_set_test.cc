#include "engine/io/patch_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/engine/io/sample_set.h"

namespace patchlab {
namespace {

using nlohmann::json;
using test::designed_set;
using test::sample_set;
using testing::HasSubstr;

std::string text_of(const PatchSet& set) {
  const Result<std::string> text = write_patch_set(set);
  if (text) return *text;
  ADD_FAILURE() << text.error().message;
  return {};
}

template <class Matrix>
bool same_bits(const Matrix& a, const Matrix& b) {
  const auto bytes = sizeof(double) * static_cast<std::size_t>(a.size());
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), bytes) == 0;
}

TEST(PatchSet, ReadsBackEveryTypeToTheSameBits) {
  const PatchSet set = sample_set();
  const Result<PatchSet> read = read_patch_set(text_of(set), "mug.json");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->patches.size(), set.patches.size());
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const PatchRecord &before = set.patches[i], &after = read->patches[i];
    EXPECT_EQ(after.id, before.id);
    EXPECT_EQ(after.name, before.name);
    EXPECT_EQ(after.frame_id, before.frame_id);
    EXPECT_EQ(after.source, before.source);
    EXPECT_EQ(after.patch.type, before.patch.type);
    EXPECT_TRUE(same_bits(after.patch.parameters, before.patch.parameters));
    EXPECT_TRUE(same_bits(*after.patch.covariance, *before.patch.covariance));
    EXPECT_TRUE(same_bits(*after.patch.covariance_local, *before.patch.covariance_local));
    EXPECT_EQ(after.provenance, before.provenance);
    EXPECT_TRUE(after.unknown.empty()) << after.unknown;
  }
}

TEST(PatchSet, ReadsBackItsSources) {
  PatchSet set = sample_set();
  set.sources[0].noise_assumed = true;
  const Result<PatchSet> read = read_patch_set(text_of(set), "mug.json");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->sources.size(), 1u);
  const PatchSource& source = read->sources[0];
  EXPECT_EQ(source.id, "scan-1");
  EXPECT_EQ(source.file, "mug.pcd");
  EXPECT_EQ(source.sha256, "5f0c");
  EXPECT_EQ(source.noise, "kinect1");
  EXPECT_TRUE(source.noise_assumed);
  EXPECT_TRUE(source.viewpoint.stated);
  EXPECT_EQ(source.viewpoint.position, Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(source.viewpoint.quaternion_xyzw, (std::array<double, 4>{0.6, 0.0, 0.0, 0.8}));
}

TEST(PatchSet, ReadsBackItsFits) {
  const Result<PatchSet> read = read_patch_set(text_of(sample_set()), "mug.json");
  ASSERT_TRUE(read) << read.error().message;
  const FitSummary fit = *read->patches[0].fit, expected = test::sample_fit();
  EXPECT_EQ(fit.method, expected.method);
  EXPECT_EQ(fit.robust, expected.robust);
  EXPECT_EQ(fit.containment, expected.containment);
  EXPECT_EQ(fit.points, expected.points);
  EXPECT_EQ(fit.outliers, expected.outliers);
  EXPECT_EQ(fit.chi2, expected.chi2);
  EXPECT_EQ(fit.dof, expected.dof);
  EXPECT_EQ(fit.p_value, expected.p_value);
  EXPECT_EQ(fit.iterations, expected.iterations);
  EXPECT_EQ(fit.residual_rms, expected.residual_rms);
  EXPECT_EQ(fit.coverage, expected.coverage);
  EXPECT_EQ(fit.accepted, expected.accepted);
  ASSERT_EQ(fit.reasons.size(), 1u);
  EXPECT_EQ(fit.reasons[0].name, "coverage");
  EXPECT_EQ(fit.reasons[0].value, 0.5);
  EXPECT_EQ(fit.reasons[0].limit, 0.75);
  EXPECT_EQ(fit.reasons[0].sentence, "Half of the patch holds no points.");
  EXPECT_TRUE(fit.warnings.empty());
}

TEST(PatchSet, IsWrittenTheSameAfterReadingIt) {
  for (const PatchSet& set : {sample_set(), designed_set()}) {
    const std::string text = text_of(set);
    const Result<PatchSet> read = read_patch_set(text, "mug.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(text_of(*read), text);
  }
}

TEST(PatchSet, KeepsNumbersAtTheEdgeOfDoubles) {
  PatchSet set = designed_set();
  PatchVector& parameters = set.patches[0].patch.parameters;
  parameters.tail<3>() << 1.7976931348623157e308, -0.0, 5e-324;
  parameters[0] = 0.1 + 0.2;
  const Result<PatchSet> read = read_patch_set(text_of(set), "sole.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(same_bits(read->patches[0].patch.parameters, parameters));
}

TEST(PatchSet, KeepsMembersItDoesNotKnowWhereTheyStood) {
  json object = json::parse(text_of(sample_set()));
  object["campaign"] = {{"site", "quarry"}};
  object["sources"][0]["operator"] = "M.";
  object["patches"][1]["observations"] = json::array({1, 2});
  object["patches"][1]["fit"]["seconds"] = 0.25;
  object["patches"][1]["pose"]["frame"] = "optical";
  object["patches"][1]["provenance"]["tool"] = "lasso";
  const Result<PatchSet> read = read_patch_set(object.dump(), "mug.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(json::parse(text_of(*read)), object);
}

TEST(PatchSet, WritesWhatItKnowsOverAnUnknownMemberOfThatName) {
  PatchSet set = sample_set();
  set.patches[0].unknown = {{"id", "somebody else"}, {"fit", {{"chi2", -1.0}, {"seconds", 0.25}}}};
  const json written = json::parse(text_of(set))["patches"][0];
  EXPECT_EQ(written["id"], set.patches[0].id);
  EXPECT_EQ(written["fit"]["chi2"], set.patches[0].fit->chi2);
  EXPECT_EQ(written["fit"]["seconds"], 0.25);
}

TEST(PatchSet, WritesADesignedPatchWithoutWhatItDoesNotHave) {
  const json written = json::parse(text_of(designed_set()))["patches"][0];
  EXPECT_TRUE(written.at("covariance").is_null());
  for (const char* absent : {"source", "covariance_local", "near_singular", "fit", "provenance"}) {
    EXPECT_FALSE(written.contains(absent)) << absent;
  }
  EXPECT_FALSE(written.at("pose").contains("covariance_ros"));
  const Result<PatchSet> read = read_patch_set(text_of(designed_set()), "sole.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->patches[0].patch.covariance);
  EXPECT_FALSE(read->patches[0].patch.covariance_local);
  EXPECT_FALSE(read->patches[0].fit);
}

TEST(PatchSet, TakesTheLocalCovarianceFromTheOtherWhereItIsMissing) {
  const PatchSet set = sample_set();
  json object = json::parse(text_of(set));
  for (json& patch : object["patches"]) patch.erase("covariance_local");
  const Result<PatchSet> read = read_patch_set(object.dump(), "mug.json");
  ASSERT_TRUE(read) << read.error().message;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const PatchMatrix& expected = *set.patches[i].patch.covariance_local;
    EXPECT_LT((*read->patches[i].patch.covariance_local - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(PatchSet, RefusesToWriteWhatIsNotFiniteByPatchAndMember) {
  PatchSet set = sample_set();
  set.patches[2].fit->p_value = std::numeric_limits<double>::quiet_NaN();
  const Result<std::string> not_a_number = write_patch_set(set);
  ASSERT_FALSE(not_a_number);
  EXPECT_EQ(not_a_number.error().code, ErrorCode::refused);
  EXPECT_THAT(not_a_number.error().message,
              HasSubstr("patch \"" + set.patches[2].id + "\": fit.p_value is not a number"));
  set = sample_set();
  (*set.patches[1].patch.covariance)(0, 3) = -std::numeric_limits<double>::infinity();
  const Result<std::string> infinite = write_patch_set(set);
  ASSERT_FALSE(infinite);
  EXPECT_THAT(infinite.error().message,
              HasSubstr("patch \"" + set.patches[1].id + "\": covariance[0][3] is infinite"));
}

TEST(PatchSet, RefusesANameThatIsNotUtf8) {
  PatchSet set = sample_set();
  set.patches[0].name = "\xff\xfe";
  const Result<std::string> text = write_patch_set(set);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::refused);
}

TEST(PatchSet, TakesReasonsThatArePlainSentences) {
  json object = json::parse(text_of(sample_set()));
  object["patches"][0]["fit"]["reasons"] = json::array({"Too few points."});
  const Result<PatchSet> read = read_patch_set(object.dump(), "mug.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->patches[0].fit->reasons[0].sentence, "Too few points.");
  EXPECT_EQ(json::parse(text_of(*read)), object);
}

TEST(PatchSet, KeepsOfAFitReportWhatItsFormatHolds) {
  FitReport report;
  report.outliers = {4, 9};
  report.chi2 = 12.5;
  report.warnings = {{"axis_undetermined", 2.0, 1.0, "The axis is loose."}};
  const FitSummary summary = report;
  EXPECT_EQ(summary.outliers, 2u);
  EXPECT_EQ(summary.chi2, 12.5);
  EXPECT_EQ(summary.warnings.size(), 1u);
}

}  // namespace
}  // namespace patchlab
