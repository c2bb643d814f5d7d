// Fusion: many sights of one surface through uncertain poses, against the truth.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numeric>

#include "engine/map/common_form.h"
#include "engine/map/patch_map.h"
#include "engine/map/touch.h"
#include "tests/engine/map/rock_scene.h"
#include "tests/engine/patch/example_patches.h"

namespace patchlab::test {
namespace {

View view_of(const RockView& seen) {
  View view{{}, {}, seen.patches, seen.map_from_view};
  for (const std::size_t truth : seen.truths) {
    view.sources.push_back("scan");
    view.ids.push_back("rock-" + std::to_string(truth));
  }
  return view;
}

// The first view fixes the map's frame.
PatchMap first_map(const RockView& seen) {
  View view = view_of(seen);
  view.map_from_view = {seen.true_map_from_view, Matrix6d::Zero()};
  return merge({"map", {}}, view, {}).map;
}

// Error of the unbounded surface in units of its covariance: the jet at the middle of the overlap.
PairDistance against_truth(const Patch& fused, const Patch& truth) {
  const Patch exact = make_patch(*truth.type, boundary(truth), curvatures(truth), axes(truth), centre(truth));
  const Overlap shared = overlap(sampled(fused), sampled(exact), 0.01);
  const Pose pose;
  return pair_distance({fused, exact, pose, plane_of(fused, exact, shared)}, Matrix6d::Zero())
      .value_or(PairDistance{});
}

RockScene scene_of(Random& random, const PatchCase& kind) {
  const Patch shape = rock_shape(random, kind);
  return {{transform(Pose{Vector3d::Zero(), -centre(shape)}, shape)}};
}

std::vector<Match> the_match() { return {{0, 0, {}, 1.0, false}}; }

class Fusion : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, Fusion, testing::ValuesIn(all_cases()), case_name);

TEST_P(Fusion, OfManySightsErrsAsMuchAsItsCovarianceSays) {
  SeededRandom random;
  for (const int sights : {2, 5, 20}) {
    double nees = 0.0, dof = 0.0;
    for (int trial = 0; trial < 60 / sights + 6; ++trial) {
      const RockScene scene = scene_of(random, GetParam());
      PatchMap map = first_map(rock_view(random, scene, {0}, true));
      for (int k = 1; k < sights; ++k)
        map = merge(map, view_of(rock_view(random, scene, {0})), the_match()).map;
      ASSERT_EQ(map.patches.size(), 1u);
      EXPECT_EQ(map.patches[0].observations.size(), static_cast<std::size_t>(sights));
      const PairDistance error = against_truth(map.patches[0].patch, scene.truth[0]);
      ASSERT_GT(error.dof, 0);
      nees += error.chi2;
      dof += error.dof;
    }
    EXPECT_NEAR(nees / dof, 1.0, 5.0 * std::sqrt(2.0 / dof)) << sights << " sights";
  }
}

TEST_P(Fusion, NeverGrowsTheCovariance) {
  SeededRandom random;
  const RockScene scene = scene_of(random, GetParam());
  PatchMap map = first_map(rock_view(random, scene, {0}, true));
  for (int k = 1; k < 8; ++k) {
    const PatchMap next = merge(map, view_of(rock_view(random, scene, {0})), the_match()).map;
    const Pose plane =
        plane_at(centre(map.patches[0].patch), axes(map.patches[0].patch).col(2), Vector3d::UnitX());
    const auto before = surface_jet(map.patches[0].patch, plane),
               after = surface_jet(next.patches[0].patch, plane);
    ASSERT_TRUE(before && after);
    const auto cov = [](const SurfaceJet& jet, const Patch& patch) -> CovJet {
      const CovJet S = jet.J_local * *patch.covariance_local * jet.J_local.transpose();
      const Eigen::Matrix<double, 6, 1> scale =
          (Eigen::Matrix<double, 6, 1>() << 10, 1, 1, 0.1, 0.1, 0.1).finished();
      return scale.asDiagonal() * S * scale.asDiagonal();
    };
    const CovJet less = cov(*before, map.patches[0].patch) - cov(*after, next.patches[0].patch);
    const double scale = cov(*before, map.patches[0].patch).norm();
    // The Jacobians are taken at each estimate, so it holds to their change.
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<CovJet>(less).eigenvalues()[0], -0.02 * scale) << k;
    map = next;
  }
}

TEST_P(Fusion, KeepsEveryOutlineInsideTheDerivedBound) {
  SeededRandom random;
  const RockScene scene = scene_of(random, GetParam());
  PatchMap map = first_map(rock_view(random, scene, {0}, true));
  for (int k = 1; k < 4; ++k) map = merge(map, view_of(rock_view(random, scene, {0}, true)), the_match()).map;
  const MapPatch& fused = map.patches[0];
  ASSERT_TRUE(validate(fused.patch)) << validate(fused.patch).error().message;
  const Boundary bound = boundary(fused.patch);
  double inner = 0.0;
  for (const Observation& seen : fused.observations) {
    for (const Vector2d& u : outline(boundary(seen.patch), 24)) {
      const Vector3d q = apply(world_from_patch(seen.patch), surface_point(u, k3(seen.patch)));
      // Seen outlines lie beside the fused surface by their errors, and go up to the equator.
      const Vector2d at = apply_inverse(world_from_patch(fused.patch), q).head<2>();
      EXPECT_LT(boundary_function(at, bound), 0.02);
      inner = std::max(inner, boundary_function(1.15 * at, bound));
    }
  }
  EXPECT_GT(inner, 0.0) << "a smaller bound would do";
}

TEST(Maps, KeepsViewsApartAndUndoesByValue) {
  SeededRandom random;
  const RockScene scene = rock_scene(random, 12);
  std::vector<std::size_t> all(12);
  std::iota(all.begin(), all.end(), 0u);
  const PatchMap before = first_map(rock_view(random, scene, {0, 1, 2, 3, 4, 5, 6, 7, 8}, true));
  const RockView seen = rock_view(random, scene, all);
  const Association found = associate(patches_of(before), seen.patches, seen.map_from_view);
  const Merged merged = merge(before, view_of(seen), found.matches);
  EXPECT_EQ(before.patches.size(), 9u);
  EXPECT_EQ(merged.map.patches.size(), 12u);
  EXPECT_EQ(merged.C.size(), 12u);
  EXPECT_EQ(merged.map.patches[0].id, before.patches[0].id);
  EXPECT_LT(merged.map_from_view.covariance.trace(), seen.map_from_view.covariance.trace());
  EXPECT_EQ(before.patches[0].observations.size(), 1u) << "undo is the earlier value";
}

TEST(Maps, GiveANewPatchAFreeId) {
  SeededRandom random;
  const RockScene scene = scene_of(random, all_cases()[0]);
  const PatchMap map = first_map(rock_view(random, scene, {0}, true));
  const PatchMap more = merge(map, view_of(rock_view(random, scene, {0})), {}).map;
  ASSERT_EQ(more.patches.size(), 2u);
  EXPECT_EQ(more.patches[1].id, "scan/rock-0");
}

// Patches that share the pose: all of them together, at once, against the truth.
TEST(Maps, SolveThePoseAndAllPatchesTogether) {
  SeededRandom random;
  double nees = 0.0, dof = 0.0;
  for (int trial = 0; trial < 25; ++trial) {
    const RockScene scene = rock_scene(random, 16);
    std::vector<std::size_t> all(16);
    std::iota(all.begin(), all.end(), 0u);
    const PatchMap map = first_map(rock_view(random, scene, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, true));
    const RockView seen = rock_view(random, scene, all);
    std::vector<Match> matches;
    for (std::size_t i = 0; i < 10; ++i) matches.push_back({i, i, {}, 1.0, false});
    const Merged merged = merge(map, view_of(seen), matches);
    for (std::size_t i = 0; i < 16; ++i) {
      const PairDistance error = against_truth(merged.map.patches[i].patch, scene.truth[i]);
      nees += error.chi2;
      dof += error.dof;
    }
  }
  EXPECT_NEAR(nees / dof, 1.0, 0.1);
}

class Touch : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, Touch, testing::ValuesIn(all_cases()), case_name);

TEST_P(Touch, ByPointsAndPlanesErrsAsMuchAsItSays) {
  SeededRandom random;
  double nees = 0.0, dof = 0.0, chi2 = 0.0, contacts = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    const RockScene scene = scene_of(random, GetParam());
    const Patch& truth = scene.truth[0];
    const RockView view = rock_view(random, scene, {0}, true);
    const Patch seen = transform(view.true_map_from_view, view.patches[0]);
    const Matrix3d cov = Matrix3d::Identity() * 1e-6;
    const Vector3d q = surface_point(0.4 * random_u(random, truth), k3(truth));
    const Vector3d point = apply(world_from_patch(truth), q) + draw(random, cov);
    const Result<Touched> touched = touched_at(seen, point, cov);
    ASSERT_TRUE(touched) << touched.error().message;
    chi2 += touched->chi2;
    contacts += touched->dof;
    const PairDistance error = against_truth(touched->patch, truth);
    nees += error.chi2;
    dof += error.dof;
  }
  EXPECT_NEAR(chi2 / contacts, 1.0, 5.0 * std::sqrt(2.0 / contacts));
  EXPECT_NEAR(nees / dof, 1.0, 5.0 * std::sqrt(2.0 / dof));
}

TEST_P(Touch, ByASoleTeachesHeightAndSlope) {
  SeededRandom random;
  const RockScene scene = scene_of(random, GetParam());
  const Patch& truth = scene.truth[0];
  const RockView view = rock_view(random, scene, {0}, true);
  const Patch seen = transform(view.true_map_from_view, view.patches[0]);
  const PatchTypeRow& sole = *find_patch_type(SurfaceType::plane, BoundaryType::circle);
  const Vector3d q = surface_point(Vector2d(0.004, -0.003), k3(truth));
  const Pose plane = plane_at(apply(world_from_patch(truth), q), axes(truth) * outward_normal(q, k3(truth)),
                              Vector3d::UnitX());
  PatchMatrix cov = 1e-10 * PatchMatrix::Identity(6, 6);
  const Patch contact = flip_normal(make_patch(sole, {sole.boundary, BoundaryVector::Constant(1, 0.02)}, {},
                                               exp_map(plane.r), plane.t, cov));
  const Result<Touched> touched = touched_by(seen, contact);
  ASSERT_TRUE(touched) << touched.error().message;
  EXPECT_EQ(touched->dof, 3);
  const auto jet = surface_jet(touched->patch, plane);
  ASSERT_TRUE(jet);
  EXPECT_NEAR(jet->value[0], 0.0, 3e-4);
  EXPECT_LT(jet->value.segment<2>(1).norm(), 3e-3);
  EXPECT_FALSE(touched_by(
      seen, random_patch(random, {find_patch_type(SurfaceType::sphere, BoundaryType::circle), 1})));
}

}  // namespace
}  // namespace patchlab::test
