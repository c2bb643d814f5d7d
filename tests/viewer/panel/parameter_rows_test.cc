#include "viewer/panel/parameter_rows.h"

#include <gtest/gtest.h>

#include "engine/patch/marginals.h"

namespace patchlab::viewer {
namespace {

Patch sphere(double kappa, double sigma_kappa) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::sphere, BoundaryType::circle);
  PatchMatrix covariance = PatchMatrix::Zero(7, 7);
  covariance.diagonal() << 6e-4 * 6e-4, sigma_kappa * sigma_kappa, 3.4e-3 * 3.4e-3, 3.1e-3 * 3.1e-3,
      1.9e-4 * 1.9e-4, 2.1e-4 * 2.1e-4, 1.2e-4 * 1.2e-4;
  return make_patch(type, {BoundaryType::circle, BoundaryVector::Constant(1, 0.0584)},
                    Eigen::VectorXd::Constant(1, kappa), Eigen::Matrix3d::Identity(), {0, 0, 1}, covariance);
}

const ParameterRow* find(const std::vector<ParameterRow>& rows, const std::string& name) {
  for (const ParameterRow& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

TEST(ParameterRows, OfASphereGiveItsRadiusWithTheSigmaThatFollowsFromKappa) {
  const std::vector<ParameterRow> rows = parameter_rows(sphere(-16.34, 0.056));
  const ParameterRow* radius = find(rows, "radius 1/|κ|");
  ASSERT_TRUE(radius);
  EXPECT_EQ(radius->value, "61.20 mm");
  EXPECT_EQ(radius->sigma, "± 0.21 mm");
  EXPECT_NEAR(radius->share, 0.056 / 16.34, 1e-9);
  ASSERT_TRUE(find(rows, "outline d"));
  EXPECT_EQ(find(rows, "outline d")->value, "58.40 mm");
  EXPECT_EQ(find(rows, "tilt x")->sigma, "± 3.4 mrad");
  EXPECT_EQ(find(rows, "centre along normal")->sigma, "± 0.12 mm");
  EXPECT_EQ(find(rows, "centre in plane")->sigma, "± 0.19 mm, 0.21 mm");
  EXPECT_FALSE(find(rows, "spin"));
}

TEST(ParameterRows, OfASphereThatMayBeFlatSayNothingOfItsRadius) {
  const std::vector<ParameterRow> rows = parameter_rows(sphere(-0.2, 0.1));
  EXPECT_FALSE(find(rows, "radius 1/|κ|"));
  EXPECT_TRUE(find(rows, "κ"));
}

TEST(ParameterRows, OfADesignedPatchHaveNoSigmas) {
  Patch patch = sphere(-10, 0.1);
  patch.covariance.reset();
  patch.covariance_local.reset();
  for (const ParameterRow& row : parameter_rows(patch)) EXPECT_TRUE(row.sigma.empty()) << row.name;
}

TEST(ParameterRows, EveryTypeOfTableIHasWordsForAllItsParameters) {
  for (const PatchTypeRow& type : patch_types()) {
    for (const std::string& name : local_names(type)) {
      const std::string words = local_words(name);
      EXPECT_EQ(words.find("kappa"), std::string::npos);
      EXPECT_EQ(words.rfind("t_", 0), std::string::npos) << name;
      EXPECT_EQ(words.rfind("w_", 0), std::string::npos) << name;
    }
  }
}

TEST(BarLength, IsLogarithmicFromATenThousandthToOne) {
  EXPECT_DOUBLE_EQ(bar_length(0.0), 0.0);
  EXPECT_DOUBLE_EQ(bar_length(1e-6), 0.0);
  EXPECT_NEAR(bar_length(1e-2), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(bar_length(3.0), 1.0);
}

TEST(StrongestPair, NamesTheTwoThatGoTogether) {
  Patch patch = sphere(-16.34, 0.056);
  PatchMatrix correlations = PatchMatrix::Identity(7, 7);
  correlations(1, 6) = correlations(6, 1) = -0.82;
  correlations(0, 2) = correlations(2, 0) = 0.3;
  const StrongestPair pair = strongest_pair(patch, correlations);
  EXPECT_EQ(pair.one, "κ");
  EXPECT_EQ(pair.other, "centre along normal");
  EXPECT_DOUBLE_EQ(pair.correlation, -0.82);
}

}  // namespace
}  // namespace patchlab::viewer
