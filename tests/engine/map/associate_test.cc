// Association of simulated views of rocks against the truth, and the distances that it rests on.
#include "engine/map/associate.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "engine/map/common_form.h"
#include "tests/engine/map/rock_scene.h"
#include "tests/engine/patch/example_patches.h"

namespace patchlab::test {
namespace {

class RockFields : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Patches, RockFields, testing::Values(20, 50, 100),
                         [](const auto& field) { return "Of" + std::to_string(field.param) + "Patches"; });

TEST_P(RockFields, AreAssociatedRightly) {
  SeededRandom random;
  Score sum;
  for (int trial = 0; trial < 200 / GetParam(); ++trial) {
    const TwoViews views = two_views(random, GetParam());
    const Association found = associate(views.a.patches, views.b.patches, views.b.map_from_view);
    sum += score(found.matches, views.a, views.b);
    EXPECT_LT(found.a_from_b.covariance.trace(), 0.05 * views.b.map_from_view.covariance.trace());
  }
  EXPECT_GE(sum.precision(), 0.99) << sum.wrong << " wrong of " << sum.right + sum.wrong;
  EXPECT_GE(sum.recall(), 0.99) << sum.right << " found of " << sum.possible;
}

TEST(Association, RefinesThePoseAsMuchAsItSays) {
  SeededRandom random;
  double nees = 0.0, chi2 = 0.0, dof = 0.0;
  constexpr int trials = 20;
  for (int trial = 0; trial < trials; ++trial) {
    const TwoViews views = two_views(random, 25);
    const Association found = associate(views.a.patches, views.b.patches, views.b.map_from_view);
    const Vector6d error = found.a_from_b.pose.vector() - views.b.true_map_from_view.vector();
    nees += error.dot(found.a_from_b.covariance.ldlt().solve(error)) / 6.0;
    chi2 += found.chi2;
    dof += found.dof;
  }
  EXPECT_NEAR(nees / trials, 1.0, 5.0 * std::sqrt(2.0 / (6.0 * trials)));
  EXPECT_NEAR(chi2 / dof, 1.0, 0.1);
}

class PairDistances : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, PairDistances, testing::ValuesIn(all_cases()), case_name);

// Of two views of one surface: chi-square with the stated degrees of freedom.
TEST_P(PairDistances, AreChiSquare) {
  SeededRandom random;
  double sum = 0.0, dof = 0.0;
  constexpr int trials = 120;
  for (int trial = 0; trial < trials; ++trial) {
    RockScene scene = rock_scene(random, 1);
    scene.truth[0] = rock_shape(random, GetParam());
    const RockView a = rock_view(random, scene, {0}, true), b = rock_view(random, scene, {0}, true);
    const Patch a_map = transform(a.true_map_from_view, a.patches[0]),
                b_map = transform(b.true_map_from_view, b.patches[0]);
    const Overlap shared = overlap(sampled(a_map), sampled(b_map), 0.0);
    ASSERT_GT(shared.share, 0.2);
    const auto distance =
        pair_distance({a_map, b_map, b.true_map_from_view, plane_of(a_map, b_map, shared)}, Matrix6d::Zero());
    ASSERT_TRUE(distance);
    sum += distance->chi2;
    dof += distance->dof;
  }
  EXPECT_NEAR(sum / dof, 1.0, 5.0 * std::sqrt(2.0 / dof));
}

TEST(Association, OfNothingIsThePoseAsGiven) {
  const UncertainPose pose{{Vector3d(0.1, 0, 0), Vector3d(1, 2, 3)}, 0.01 * Matrix6d::Identity()};
  const Association found = associate({}, {}, pose);
  EXPECT_TRUE(found.matches.empty());
  EXPECT_EQ(found.a_from_b.pose.t, pose.pose.t);
  EXPECT_LT((found.a_from_b.covariance - pose.covariance).norm(), 1e-15);
}

TEST(Association, TurnsAPatchOverThatFacesTheOtherWay) {
  SeededRandom random;
  const Patch patch = random_patch(random, all_cases()[0]);
  const std::vector<Patch> a = {patch}, b = {flip_normal(patch)};
  const Association found = associate(a, b, {});
  ASSERT_EQ(found.matches.size(), 1u);
  EXPECT_TRUE(found.matches[0].flipped);
  EXPECT_LT(found.matches[0].distance.chi2, 1e-9);
}

TEST(Association, TellsRocksBesideEachOtherApart) {
  SeededRandom random;
  Patch patch = random_patch(random, all_cases()[0]);
  const Vector3d aside = axes(patch).col(0) * (3.0 * boundary(patch).d.maxCoeff());
  const std::vector<Patch> a = {patch}, b = {transform(Pose{Vector3d::Zero(), aside}, patch)};
  EXPECT_TRUE(associate(a, b, {}).matches.empty());
}

}  // namespace
}  // namespace patchlab::test
