#include "engine/map/queries.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/engine/map/rock_scene.h"
#include "tests/engine/patch/example_patches.h"

namespace patchlab::test {
namespace {

// Spread of `answer` when both patches err as their covariances say.
template <class Answer>
double sampled_sigma(Random& random, const Patch& a, const Patch& b, const Answer& answer) {
  constexpr int count = 1500;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double value = answer(moved_in_chart(a, draw(random, *a.covariance_local)),
                                moved_in_chart(b, draw(random, *b.covariance_local)));
    sum += value;
    squares += value * value;
  }
  return std::sqrt(squares / count - sum * sum / count / count);
}

class Queries : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, Queries, testing::ValuesIn(all_cases()), case_name);

TEST_P(Queries, SpreadAsTheySay) {
  SeededRandom random;
  const Patch a = random_patch(random, GetParam()), b = random_patch(random, GetParam());
  const Vector3d up = random.unit3();
  const auto distance = [](const Patch& x, const Patch& y) { return centre_distance(x, y).value; };
  const auto angle = [](const Patch& x, const Patch& y) { return normal_angle(x, y).value; };
  const auto lean = [&](const Patch& x, const Patch&) { return tilt(x, up).value; };
  EXPECT_NEAR(sampled_sigma(random, a, b, distance) / centre_distance(a, b).sigma, 1.0, 0.12);
  EXPECT_NEAR(sampled_sigma(random, a, b, angle) / normal_angle(a, b).sigma, 1.0, 0.12);
  EXPECT_NEAR(sampled_sigma(random, a, b, lean) / tilt(a, up).sigma, 1.0, 0.12);
}

TEST_P(Queries, ProbabilityOfATiltIsTheShareOfSamples) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Vector3d n = axes(patch).col(2);
  for (const double mean : {0.0, 0.01, 0.3}) {
    const Vector3d up = exp_map(mean * n.unitOrthogonal()) * n;
    const double limit = mean + 0.008;
    constexpr int count = 3000;
    int over = 0;
    for (int i = 0; i < count; ++i)
      over += tilt(moved_in_chart(patch, draw(random, *patch.covariance_local)), up).value > limit;
    const double share = static_cast<double>(over) / count;
    EXPECT_NEAR(tilt_exceeds(patch, up, limit), share,
                5.0 * std::sqrt((share * (1.0 - share) + 1e-3) / count))
        << mean;
  }
  EXPECT_LT(tilt_exceeds(patch, n, 3.0), 1e-12);
}

// A foot over the middle of the ground, facing it.
Patch foot_over(const Patch& ground, double gap, const Patch& foot) {
  const Matrix3d R = axes(ground) * Vector3d(1, -1, -1).asDiagonal();
  return make_patch(*foot.type, boundary(foot), curvatures(foot), R,
                    centre(ground) + gap * axes(ground).col(2), foot.covariance_local);
}

Patch sole(Random& random) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::convex_quad);
  return make_patch(type, {type.boundary, (BoundaryVector(5) << 0.03, 0.03, 0.025, 0.025, 0.5).finished()},
                    {}, Matrix3d::Identity(), Vector3d::Zero(),
                    random_patch(random, {&type, 1}).covariance_local);
}

TEST_P(Queries, FootFitsWithTheSpreadThatItSays) {
  SeededRandom random;
  const Patch ground = random_patch(random, GetParam());
  const Patch foot = foot_over(ground, 0.03, sole(random));
  const FootFit fit = foot_fit(foot, ground);
  EXPECT_GT(fit.share, 0.8);
  EXPECT_GE(fit.rocking.value, 0.0);
  EXPECT_LE(fit.gap.value, 0.03 + 1e-12);
  // A foot of one place: the least clearance of many is no linear function.
  const auto tip = [](const Patch& wide) {
    Patch narrow = wide;
    narrow.parameters.head<5>() << 1e-6, 1e-6, 1e-6, 1e-6, 0.5;
    return narrow;
  };
  const auto gap = [&](const Patch& x, const Patch& y) { return foot_fit(tip(x), y).gap.value; };
  EXPECT_NEAR(sampled_sigma(random, foot, ground, gap) / foot_fit(tip(foot), ground).gap.sigma, 1.0, 0.12);
}

TEST(FootFit, OfASoleOnFlatGroundIsItsHeight) {
  SeededRandom random;
  const Patch ground = random_patch(random, {find_patch_type(SurfaceType::plane, BoundaryType::circle), 1});
  const FootFit fit = foot_fit(foot_over(ground, 0.012, sole(random)), ground);
  EXPECT_NEAR(fit.gap.value, 0.012, 1e-12);
  EXPECT_NEAR(fit.rocking.value, 0.0, 1e-12);
  EXPECT_EQ(fit.share, 1.0);
}

TEST(FootFit, OfASoleOnABallRocksByTheBallsHeight) {
  SeededRandom random;
  const PatchTypeRow& type = *find_patch_type(SurfaceType::sphere, BoundaryType::circle);
  const Patch ball = make_patch(type, {type.boundary, BoundaryVector::Constant(1, 0.1)},
                                Eigen::VectorXd::Constant(1, -5.0), Matrix3d::Identity(), Vector3d::Zero());
  const FootFit fit = foot_fit(foot_over(ball, 0.01, sole(random)), ball);
  EXPECT_NEAR(fit.gap.value, 0.01, 1e-12);
  EXPECT_NEAR(fit.rocking.value, std::hypot(0.2 + 0.01, 0.03) - 0.2 - 0.01, 1e-12);
}

TEST_P(Queries, FindThePatchesAround) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  for (int i = 0; i < 20; ++i) {
    const Vector3d q = world_point(patch, random_u(random, patch));
    EXPECT_NEAR(distance_to(patch, q), 0.0, 1e-9);
    const Vector3d point = q + 0.3 * random.unit3();
    double least = (q - point).norm();
    for (int j = 0; j < 300; ++j)
      least = std::min(least, (world_point(patch, random_u(random, patch)) - point).norm());
    EXPECT_LE(distance_to(patch, point), least + 1e-3);
    EXPECT_GE(distance_to(patch, point), least - 0.05);
  }
  const std::vector<Patch> all = {transform(Pose{Vector3d::Zero(), Vector3d(5, 0, 0)}, patch), patch,
                                  transform(Pose{Vector3d::Zero(), Vector3d(0.5, 0, 0)}, patch)};
  const std::vector<NearPatch> near = patches_within(all, centre(patch), 1.0);
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[0].index, 1u);
  EXPECT_EQ(near[1].index, 2u);
}

}  // namespace
}  // namespace patchlab::test
