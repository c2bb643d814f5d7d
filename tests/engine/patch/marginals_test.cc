#include "engine/patch/marginals.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "engine/base/chi_square.h"
#include "tests/engine/patch/example_patches.h"
#include "tests/support/monte_carlo.h"

namespace patchlab::test {
namespace {

class Marginals : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, Marginals, testing::ValuesIn(all_cases()), case_name);

constexpr int count = 2000;

double sampled_sigma(Random& random, const Patch& patch,
                     const std::function<double(const Patch&)>& quantity) {
  const double base = quantity(patch);
  const auto f = [&](const VectorXd& e) -> VectorXd {
    return VectorXd::Constant(1, quantity(moved_in_chart(patch, e)) - base);
  };
  return std::sqrt(sampled_covariance(random, *patch.covariance_local, count, f)(0, 0));
}

constexpr double sampling_slack =
    5.0 / 63.2;  // five standard deviations of a standard deviation: 5 / sqrt(2 count)

// A patch a hundred times more certain, so that the first order is all there is.
Patch certain_patch(Random& random, const PatchCase& patch_case) {
  Patch patch = random_patch(random, patch_case);
  *patch.covariance_local *= 1e-4;
  return patch;
}

TEST_P(Marginals, CentreCovarianceIsTheBlockOfTheParameters) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  EXPECT_TRUE(same_covariance(cov_centre(patch), patch.covariance->bottomRightCorner(3, 3), 1e-12));
}

TEST_P(Marginals, HeightSigmaAgreesWithSampling) {
  SeededRandom random;
  const Patch patch = certain_patch(random, GetParam());
  const Vector2d u = random_u(random, patch);
  const Vector3d q = world_point(patch, u);
  const Vector3d n = axes(patch) * outward_normal(surface_point(u, k3(patch)), k3(patch));
  const auto along_the_normal =
      [&](const Patch& moved) {  // where the moved surface meets the normal through q
        const RayHits hits =
            ray_hits(apply_inverse(world_from_patch(moved), q + n), -axes(moved).transpose() * n, k3(moved));
        return hits.s[0];
      };
  EXPECT_NEAR(height_sigma(patch, u) / sampled_sigma(random, patch, along_the_normal), 1.0, sampling_slack);
}

TEST_P(Marginals, HeightSigmaAtTheCentreIsThatOfTz) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const int t_z = patch.type->size() - 1;
  EXPECT_NEAR(height_sigma(patch, Vector2d::Zero()), std::sqrt((*patch.covariance_local)(t_z, t_z)), 1e-15);
}

TEST_P(Marginals, OutlineBandAgreesWithSampling) {
  SeededRandom random;
  Patch patch = certain_patch(random, GetParam());
  const int at = patch.type->rotation_at();  // the band is of the tangent plane: no tilt
  patch.covariance_local->middleRows(at, 2).setZero();
  patch.covariance_local->middleCols(at, 2).setZero();
  patch.covariance_local->diagonal().segment(at, 2).setConstant(1e-30);
  const std::vector<BandPoint> band = outline_band(patch, 8);
  EXPECT_EQ(band.size(), outline(boundary(patch), 8).size());
  for (std::size_t i = 1; i < band.size(); i += 3) {
    const double s = static_cast<double>(i) / static_cast<double>(band.size());
    const auto across = [&](const Patch& moved) {
      const Vector3d q = apply(world_from_patch(moved), Vector3d(lift(outline_point(boundary(moved), s).u)));
      return apply_inverse(world_from_patch(patch), q).head<2>().dot(band[i].outward);
    };
    EXPECT_NEAR(band[i].sigma / sampled_sigma(random, patch, across), 1.0, sampling_slack);
  }
}

TEST_P(Marginals, NormalConeHoldsItsProbability) {
  SeededRandom random;
  const Patch patch = certain_patch(random, GetParam());
  const NormalCone cone = normal_cone(patch, 0.9);
  const Eigen::MatrixXd L = patch.covariance_local->llt().matrixL();
  int inside = 0;
  for (int i = 0; i < count; ++i) {
    VectorXd e(L.rows());
    for (double& entry : e) entry = random.normal();
    const Vector3d turn =
        cone.normal.cross(axes(moved_in_chart(patch, L * e)).col(2));  // rotation vector, small
    const Vector2d scaled = (cone.axes.transpose() * turn).cwiseQuotient(cone.half_angles);
    if (scaled.squaredNorm() <= 1.0) ++inside;
  }
  EXPECT_NEAR(inside / static_cast<double>(count), 0.9, 5.0 * std::sqrt(0.09 / count));
  EXPECT_LT((cone.axes.transpose() * cone.normal).norm(), 1e-14);
  EXPECT_GE(cone.half_angles[0], cone.half_angles[1]);
  EXPECT_EQ(cone.apex, centre(patch));
}

TEST_P(Marginals, SigmasAndCorrelationsRebuildTheCovariance) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const PatchVector sigma = sigmas(*patch.covariance);
  const PatchMatrix rho = correlation(*patch.covariance);
  EXPECT_LT((rho.diagonal().array() - 1.0).abs().maxCoeff(), 1e-14);
  EXPECT_LE(rho.cwiseAbs().maxCoeff(), 1.0 + 1e-14);
  EXPECT_TRUE(same_covariance(sigma.asDiagonal() * rho * sigma.asDiagonal(), *patch.covariance, 1e-12));
}

TEST(Correlation, IsZeroWhereAVarianceIsZero) {
  PatchMatrix cov = PatchMatrix::Zero(3, 3);
  cov(0, 0) = 4.0;
  const PatchMatrix rho = correlation(cov);
  EXPECT_EQ(rho(0, 0), 1.0);
  EXPECT_EQ(rho(1, 1), 0.0);
  EXPECT_TRUE(rho.allFinite());
}

TEST(Ellipsoid, HasItsAxesLongestFirstRightHandedAndUnit) {
  SeededRandom random;
  const Matrix3d R = exp_map(random.normal3());
  const Matrix3d cov = R * Vector3d(1, 9, 4).asDiagonal() * R.transpose();
  const Ellipsoid e = ellipsoid(Vector3d(1, 2, 3), cov, 0.95);
  EXPECT_EQ(e.centre, Vector3d(1, 2, 3));
  EXPECT_LT((e.half_lengths / ellipsoid_scale(0.95, 3) - Vector3d(3, 2, 1)).norm(), 1e-14);
  EXPECT_NEAR(e.axes.determinant(), 1.0, 1e-14);
  EXPECT_NEAR(std::abs(e.axes.col(0).dot(R.col(1))), 1.0, 1e-14);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(e.axes.col(i).maxCoeff(), e.axes.col(i).cwiseAbs().maxCoeff());
}

TEST(Ellipsoid, OfASingularCovarianceIsFlat) {
  const Ellipsoid e = ellipsoid(Vector3d::Zero(), Vector3d(1, 0, 0).asDiagonal(), 0.95);
  EXPECT_GT(e.half_lengths[0], 0.0);
  EXPECT_EQ(e.half_lengths[1], 0.0);
  EXPECT_EQ(e.half_lengths[2], 0.0);
}

TEST(Ellipsoid, HoldsItsProbability) {
  SeededRandom random;
  const Patch patch = random_patch(random, all_cases()[0]);
  const Ellipsoid e = centre_ellipsoid(patch, 0.5);
  const Matrix3d L = cov_centre(patch).llt().matrixL();
  int inside = 0;
  for (int i = 0; i < 4 * count; ++i) {
    const Vector3d scaled = (e.axes.transpose() * (L * random.normal3())).cwiseQuotient(e.half_lengths);
    if (scaled.squaredNorm() <= 1.0) ++inside;
  }
  EXPECT_NEAR(inside / (4.0 * count), 0.5, 5.0 * std::sqrt(0.25 / (4 * count)));
}

}  // namespace
}  // namespace patchlab::test
