#include "engine/map/common_form.h"

#include <gtest/gtest.h>

#include "tests/engine/patch/example_patches.h"
#include "tests/support/numeric_jacobian.h"

namespace patchlab::test {
namespace {

class CommonForms : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, CommonForms, testing::ValuesIn(all_cases()), case_name);

// A plane near a point of the patch, somewhat off it and tilted.
Pose near_plane(Random& random, const Patch& patch) {
  const Vector2d u = 0.7 * random_u(random, patch);
  const Vector3d q = surface_point(u, k3(patch));
  const Vector3d n = axes(patch) * outward_normal(q, k3(patch));
  return plane_at(apply(world_from_patch(patch), q) + 0.003 * random.normal3(), n + 0.1 * random.normal3(),
                  random.unit3());
}

TEST_P(CommonForms, HeightSlopeAndCurvatureAreThoseOfTheSurface) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Pose plane = near_plane(random, patch);
  const auto jet = surface_jet(patch, plane);
  ASSERT_TRUE(jet);
  const auto height_at = [&](const Vector2d& v) {
    return surface_jet(patch, {plane.r, apply(plane, Vector3d(v.x(), v.y(), 0.0))})->value[0];
  };
  const Vector3d foot = apply(plane, Vector3d(0, 0, jet->value[0]));
  EXPECT_NEAR(implicit(apply_inverse(world_from_patch(patch), foot), k3(patch)), 0.0, 1e-14);
  const double e = 1e-4, h = height_at({0, 0});
  EXPECT_NEAR(jet->value[1], (height_at({e, 0}) - height_at({-e, 0})) / (2 * e), 1e-5);
  EXPECT_NEAR(jet->value[2], (height_at({0, e}) - height_at({0, -e})) / (2 * e), 1e-5);
  EXPECT_NEAR(jet->value[3], (height_at({e, 0}) + height_at({-e, 0}) - 2 * h) / (e * e), 1e-3);
  EXPECT_NEAR(jet->value[5], (height_at({0, e}) + height_at({0, -e}) - 2 * h) / (e * e), 1e-3);
  EXPECT_NEAR(
      jet->value[4],
      (height_at({e, e}) + height_at({-e, -e}) - height_at({e, -e}) - height_at({-e, e})) / (4 * e * e),
      1e-3);
}

TEST_P(CommonForms, MoveWithThePatchAsTheirJacobiansSay) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Pose plane = near_plane(random, patch);
  const VectorXd zero = VectorXd::Zero(patch.type->size());
  const auto jet = [&](const VectorXd& e) -> VectorXd {
    return surface_jet(moved_in_chart(patch, e), plane)->value;
  };
  const auto quadric = [&](const VectorXd& e) -> VectorXd {
    return surface_quadric(moved_in_chart(patch, e), plane).value;
  };
  EXPECT_TRUE(
      jacobian_matches(surface_jet(patch, plane)->J_local, jet, zero, {.step = 1e-4, .tolerance = 1e-8}));
  EXPECT_TRUE(jacobian_matches(surface_quadric(patch, plane).J_local, quadric, zero,
                               {.step = 1e-4, .tolerance = 1e-8}));
}

TEST_P(CommonForms, MoveWithThePoseThatPutsThePatchThere) {
  SeededRandom random;
  const Patch patch_b = random_patch(random, GetParam());
  const Pose pose{1.3 * random.unit3(), random.normal3()};
  const Patch patch = transform(pose, patch_b);
  const Pose plane = near_plane(random, patch);
  const auto jet = [&](const VectorXd& e) -> VectorXd {
    return surface_jet(transform(Pose{pose.r + e.head<3>(), pose.t + e.tail<3>()}, patch_b), plane)->value;
  };
  EXPECT_TRUE(jacobian_matches(surface_jet(patch, plane)->J_wt * J_wt_pose(pose, patch), jet,
                               VectorXd::Zero(6), {.step = 1e-4, .tolerance = 1e-8}));
}

TEST_P(CommonForms, AreTheSameForEveryDescription) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Pose plane = near_plane(random, patch);
  std::vector<Patch> others = {conventional(patch)};
  if (!patch.type->revolute()) others.push_back(half_turn(patch));
  if (!patch.type->revolute() && patch.type->curvature_size != 1) others.push_back(swap_axes(patch));
  for (const Patch& other : others) {
    EXPECT_LT((surface_jet(other, plane)->value - surface_jet(patch, plane)->value).norm(), 1e-11);
    EXPECT_LT((surface_quadric(other, plane).value - surface_quadric(patch, plane).value).norm(), 1e-11);
    EXPECT_LT((surface_jet(other, plane)->J_local * *other.covariance_local *
                   surface_jet(other, plane)->J_local.transpose() -
               surface_jet(patch, plane)->J_local * *patch.covariance_local *
                   surface_jet(patch, plane)->J_local.transpose())
                  .norm(),
              1e-9);
  }
}

// A sphere rolled in itself is described by another apex, and is the same quadric.
TEST(CommonForm, KnowsNoApexOfASphere) {
  SeededRandom random;
  const PatchTypeRow& type = *find_patch_type(SurfaceType::sphere, BoundaryType::circle);
  const double kappa = -8.0;
  const Eigen::VectorXd k = Eigen::VectorXd::Constant(1, kappa);
  const Boundary bound{BoundaryType::circle, BoundaryVector::Constant(1, 0.05)};
  const Matrix3d R = exp_map(random.unit3()), turned = R * exp_map(Vector3d(0.3, -0.2, 0.0));
  const Vector3d middle(0.2, 0.5, 0.9);
  const Patch one = make_patch(type, bound, k, R, middle - R.col(2) / kappa);
  const Patch other = make_patch(type, bound, k, turned, middle - turned.col(2) / kappa);
  const Pose plane = plane_at(centre(one), R.col(2), Vector3d::UnitX());
  EXPECT_LT((surface_quadric(one, plane).value - surface_quadric(other, plane).value).norm(), 1e-13);
  EXPECT_LT((surface_jet(one, plane)->value - surface_jet(other, plane)->value).norm(), 1e-12);
}

// At their apex a sphere and a circular paraboloid, a plane and a flat paraboloid have one jet.
TEST(CommonForm, IsTheSameForNeighbours) {
  const Patch sphere = make_patch(*find_patch_type(SurfaceType::sphere, BoundaryType::circle),
                                  {BoundaryType::circle, BoundaryVector::Constant(1, 0.05)},
                                  Eigen::VectorXd::Constant(1, 3.0), Matrix3d::Identity(), Vector3d::Zero());
  const Patch bowl = make_patch(*find_patch_type(SurfaceType::circular_paraboloid, BoundaryType::circle),
                                {BoundaryType::circle, BoundaryVector::Constant(1, 0.05)},
                                Eigen::VectorXd::Constant(1, 3.0), Matrix3d::Identity(), Vector3d::Zero());
  EXPECT_LT((surface_jet(sphere, {})->value - surface_jet(bowl, {})->value).norm(), 1e-15);
}

TEST(CommonForm, OfASurfaceThatTheLineMissesIsNothing) {
  const Patch sphere = make_patch(*find_patch_type(SurfaceType::sphere, BoundaryType::circle),
                                  {BoundaryType::circle, BoundaryVector::Constant(1, 0.05)},
                                  Eigen::VectorXd::Constant(1, 3.0), Matrix3d::Identity(), Vector3d::Zero());
  EXPECT_FALSE(surface_jet(sphere, {Vector3d::Zero(), Vector3d(1.0, 0.0, 0.0)}));
  EXPECT_FALSE(surface_jet(sphere, {Vector3d(3.0, 0.0, 0.0), Vector3d::Zero()})) << "seen from behind";
}

}  // namespace
}  // namespace patchlab::test
