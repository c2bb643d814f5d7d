#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/patch/patch.h"
#include "tests/engine/patch/example_patches.h"

namespace patchlab::test {
namespace {

using testing::HasSubstr;

class PatchValidity : public testing::TestWithParam<PatchCase> {
 protected:
  PatchValidity() : patch_(random_patch(random_, GetParam())) {}
  std::string reason() const {
    const Result<void> result = validate(patch_);
    return result ? "" : result.error().message;
  }
  SeededRandom random_;
  Patch patch_;
};
class TwoCurvatures : public PatchValidity {};
class HalfSurfaceValidity : public PatchValidity {};
INSTANTIATE_TEST_SUITE_P(Table1, PatchValidity, testing::ValuesIn(all_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Table1, TwoCurvatures, testing::ValuesIn(cases_where([](const PatchTypeRow& type) {
                           return type.curvature_size == 2;
                         })),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Table1, HalfSurfaceValidity,
                         testing::ValuesIn(cases_where([](const PatchTypeRow& type) {
                           return type.surface == SurfaceType::sphere ||
                                  type.surface == SurfaceType::circular_cylinder;
                         })),
                         case_name);

TEST_P(PatchValidity, AGoodPatchHasNoReason) { EXPECT_EQ(reason(), ""); }

TEST_P(PatchValidity, ReasonsAreSentencesThatNameThePatch) {
  patch_.parameters[0] = -1.0;
  EXPECT_THAT(reason(), HasSubstr(std::string(name(patch_.type->surface))));
  EXPECT_EQ(reason().back(), '.');
}

TEST_P(PatchValidity, MissingParametersAreRefused) {
  patch_.parameters.conservativeResize(patch_.parameters.size() - 1);
  EXPECT_THAT(reason(), HasSubstr("parameters"));
}

TEST_P(PatchValidity, NumbersThatAreNotFiniteAreRefusedByName) {
  const std::vector<std::string> names = parameter_names(*patch_.type);
  for (Eigen::Index i = 0; i < patch_.parameters.size(); ++i) {
    const double before = patch_.parameters[i];
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      patch_.parameters[i] = bad;
      EXPECT_THAT(reason(), HasSubstr(" " + names[static_cast<std::size_t>(i)] + " "));
    }
    patch_.parameters[i] = before;
  }
}

TEST_P(PatchValidity, SizesThatAreNotPositiveAreRefused) {
  patch_.parameters[0] = patch_.type->boundary == BoundaryType::convex_quad ? -0.1 : 0.0;
  EXPECT_NE(reason(), "");
}

TEST_P(PatchValidity, LongOrientationVectorsAreRefused) {
  const int at = patch_.type->rotation_at(), size = patch_.type->rotation_size;
  patch_.parameters.segment(at, size).setZero();
  patch_.parameters[at] = std::numbers::pi;
  EXPECT_EQ(reason(), "");
  patch_.parameters[at] = 3.2;
  EXPECT_THAT(reason(), HasSubstr("orientation"));
}

TEST_P(PatchValidity, WrongCovariancesAreRefused) {
  for (std::optional<PatchMatrix> Patch::*covariance : {&Patch::covariance, &Patch::covariance_local}) {
    const PatchMatrix good = *(patch_.*covariance);
    const auto with = [&](const PatchMatrix& bad) {
      patch_.*covariance = bad;
      const std::string why = reason();
      patch_.*covariance = good;
      return why;
    };
    PatchMatrix bad = good;
    bad(0, 1) += 1e-3 * std::sqrt(good(0, 0) * good(1, 1));
    EXPECT_THAT(with(bad), HasSubstr("symmetric"));
    bad = good;
    bad(1, 1) = -bad(1, 1);
    EXPECT_THAT(with(bad), HasSubstr("negative variance"));
    bad = good;
    bad(0, 1) = bad(1, 0) = 1.1 * std::sqrt(good(0, 0) * good(1, 1));
    EXPECT_THAT(with(bad), HasSubstr("positive semi-definite"));
    bad = good;
    bad(0, 0) = std::nan("");
    EXPECT_THAT(with(bad), HasSubstr("finite"));
    EXPECT_THAT(with(PatchMatrix::Identity(3, 3)), HasSubstr("rows and columns"));
  }
}

TEST_P(PatchValidity, SingularCovariancesAreAllowed) {
  const int n = patch_.type->size();
  const PatchVector v = PatchVector::LinSpaced(n, -1.0, 1.0);
  patch_.covariance = v * v.transpose();
  patch_.covariance_local = PatchMatrix::Zero(n, n);
  EXPECT_EQ(reason(), "");
}

TEST_P(TwoCurvatures, HaveTheSignsOfTheirSurface) {
  double& kappa_x = patch_.parameters[patch_.type->curvature_at()];
  kappa_x = -kappa_x;
  EXPECT_THAT(reason(), HasSubstr("curvatures"));
  kappa_x = 0.0;
  EXPECT_THAT(reason(), HasSubstr("curvatures"));
}

TEST_P(HalfSurfaceValidity, EndsAtTheRadius) {
  const double d = patch_.parameters[patch_.type->boundary_size - 1];
  double& kappa = patch_.parameters[patch_.type->curvature_at()];
  kappa = (1.0 + 1e-13) / d;
  EXPECT_EQ(reason(), "");
  kappa = -1.001 / d;
  EXPECT_THAT(reason(), HasSubstr("radius"));
}

TEST(Validity, QuadsNeedBothDiagonalsAndAnAngle) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::convex_quad);
  const auto valid = [&](std::initializer_list<double> d) {
    BoundaryVector sizes(5);
    std::copy(d.begin(), d.end(), sizes.begin());
    return validate(make_patch(type, {type.boundary, sizes}, {}, Matrix3d::Identity(), Vector3d::Zero()))
        .ok();
  };
  EXPECT_TRUE(valid({0.1, 0.1, 0.1, 0.1, 0.7}));
  EXPECT_TRUE(valid({0.0, 0.1, 0.1, 0.1, 0.7}));
  EXPECT_FALSE(valid({0.0, 0.1, 0.0, 0.1, 0.7}));
  EXPECT_FALSE(valid({0.1, 0.0, 0.1, 0.0, 0.7}));
  EXPECT_FALSE(valid({0.1, 0.1, 0.1, 0.1, 0.0}));
  EXPECT_FALSE(valid({0.1, 0.1, 0.1, 0.1, 1.6}));
}

TEST(Validity, APatchHasAType) { EXPECT_FALSE(validate(Patch{})); }

}  // namespace
}  // namespace patchlab::test
