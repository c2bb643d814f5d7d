#include "engine/patch/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/exact.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

// k3 of every surface of Table I, both signs.
const std::vector<Vector3d> both_sided_surfaces = {
    {3, 5, 0},   {-3, -5, 0}, {-3, 5, 0}, {3, -5, 0},   {0, 4, 0}, {0, -4, 0}, {4, 4, 0},
    {-4, -4, 0}, {0, 0, 0},   {4, 4, 4},  {-4, -4, -4}, {0, 4, 4}, {0, -4, -4}};

Vector2d near_u(Random& random) { return {random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15)}; }

// Eqs. (23), (27) as printed, with 60 digits.
double exact_height(double kappa, double rho) {
  const Exact k = kappa, root = 1 - k * k * Exact(rho) * Exact(rho);
  return static_cast<double>((1 - sqrt(root < 0 ? Exact(0) : root)) / k);
}

TEST(Surface, ExplicitPointsSatisfyTheImplicitForm) {
  SeededRandom random;
  for (const Vector3d& k3 : both_sided_surfaces) {
    for (int i = 0; i < 20; ++i) EXPECT_NEAR(implicit(surface_point(near_u(random), k3), k3), 0.0, 1e-16);
  }
}

TEST(Surface, HeightOfSpheresAndCylindersIsExactForEveryCurvature) {
  for (const double rho : {1e-9, 1e-3, 0.05, 0.1}) {
    for (const double kappa : {1e-12, -1e-12, 1e-8, 1e-3, -1.0, 5.0, -9.0, 9.99}) {
      const double exact = exact_height(kappa, rho);
      EXPECT_NEAR(height({0.6 * rho, 0.8 * rho}, {kappa, kappa, kappa}) / exact, 1.0, 1e-13)
          << kappa << " " << rho;
      EXPECT_NEAR(height({7.0, rho}, {0, kappa, kappa}) / exact, 1.0, 1e-13) << kappa << " " << rho;
    }
  }
}

TEST(Surface, HeightAtTheRimAndWithoutCurvatureIsFinite) {
  EXPECT_NEAR(height({0.0, 0.1}, {10, 10, 10}), 0.1, 1e-8);
  EXPECT_NEAR(height({0.0, 0.1 * (1 + 1e-15)}, {0, -10, -10}), -0.1, 1e-7);
  EXPECT_EQ(height({0.3, 0.4}, {0, 0, 0}), 0.0);
}

TEST(Surface, GradientMatchesDifferences) {
  SeededRandom random;
  for (const Vector3d& k3 : both_sided_surfaces) {
    const auto f = [&](const VectorXd& q) -> VectorXd {
      return VectorXd::Constant(1, implicit(Vector3d(q), k3));
    };
    const Vector3d q = 0.2 * random.normal3();
    EXPECT_TRUE(jacobian_matches(gradient(q, k3).transpose(), f, q));
  }
}

TEST(Surface, OutwardNormalIsZAtTheApexAndPointsToNegativeF) {
  SeededRandom random;
  for (const Vector3d& k3 : both_sided_surfaces) {
    EXPECT_EQ(outward_normal(Vector3d::Zero(), k3), Vector3d::UnitZ());
    const Vector3d q = surface_point(near_u(random), k3);
    EXPECT_NEAR(outward_normal(q, k3).norm(), 1.0, 1e-15);
    EXPECT_LT(implicit(q + 1e-3 * outward_normal(q, k3), k3), 0.0);
  }
}

TEST(Surface, PositiveCurvatureBendsTowardsZ) {
  for (const Vector3d& k3 : {Vector3d(0, 4, 0), Vector3d(4, 4, 4), Vector3d(0, 4, 4)}) {
    EXPECT_GT(height({0.0, 0.1}, k3), 0.0);
    EXPECT_LT(height({0.0, 0.1}, -k3), 0.0);
  }
}

TEST(Surface, HeightDerivativesMatchDifferences) {
  SeededRandom random;
  for (const Vector3d& k3 : both_sided_surfaces) {
    const Vector2d u = near_u(random);
    const auto of_u = [&](const VectorXd& x) -> VectorXd {
      return VectorXd::Constant(1, height(Vector2d(x), k3));
    };
    const auto of_k = [&](const VectorXd& k) -> VectorXd {
      return VectorXd::Constant(1, height(u, Vector3d(k)));
    };
    EXPECT_TRUE(jacobian_matches(J_height_u(u, k3), of_u, u, {.step = 2e-4})) << k3.transpose();
    EXPECT_TRUE(jacobian_matches(J_height_k3(u, k3), of_k, k3, {.step = 1e-2})) << k3.transpose();
  }
}

TEST(Surface, DerivativesInTheWorldFrameMatchDifferences) {
  SeededRandom random;
  for (const Vector3d& k3 : both_sided_surfaces) {
    for (const double length : {0.0, 1e-8, 1.0, std::numbers::pi}) {
      const Pose pose = {length * random.unit3(), random.normal3()};
      const Vector3d q = apply(pose, 0.2 * random.normal3());
      VectorXd p(9);
      p << k3, pose.r, pose.t;
      const auto at = [&](const VectorXd& x, const Vector3d& point) {
        return derivatives(point, x.head<3>(), {x.segment<3>(3), x.tail<3>()});
      };
      const SurfaceDerivatives d = at(p, q);
      EXPECT_NEAR(d.f, implicit(apply_inverse(pose, q), k3), 2e-14);
      const auto f_of_q = [&](const VectorXd& x) -> VectorXd { return VectorXd::Constant(1, at(p, x).f); };
      const auto f_of_p = [&](const VectorXd& x) -> VectorXd { return VectorXd::Constant(1, at(x, q).f); };
      const auto g_of_p = [&](const VectorXd& x) -> VectorXd { return at(x, q).J_f_q.transpose(); };
      EXPECT_TRUE(jacobian_matches(d.J_f_q, f_of_q, q));
      EXPECT_TRUE(jacobian_matches(d.J_f_p, f_of_p, p));
      EXPECT_TRUE(jacobian_matches(d.J_g_p, g_of_p, p));
    }
  }
}

TEST(Surface, ModelledSheetIsTheNearHalfOfSpheresAndCylinders) {
  const Vector3d sphere(-10, -10, -10), cylinder(0, 5, 5), paraboloid(3, 5, 0);
  EXPECT_TRUE(on_modelled_sheet({0, 0, 0}, sphere));
  EXPECT_TRUE(on_modelled_sheet({0.1, 0, -0.1}, sphere));
  EXPECT_FALSE(on_modelled_sheet({0.05, 0, -0.15}, sphere));
  EXPECT_FALSE(on_modelled_sheet({0, 0, 0.01}, sphere));
  EXPECT_TRUE(on_modelled_sheet({7, 0.2, 0.2 * (1 + 1e-13)}, cylinder));
  EXPECT_FALSE(on_modelled_sheet({7, 0, 0.4}, cylinder));
  EXPECT_TRUE(on_modelled_sheet({7, 7, -99}, paraboloid));
}

TEST(RayHits, AreOnTheSurfaceInOrder) {
  SeededRandom random;
  int twice = 0;
  for (const Vector3d& k3 : both_sided_surfaces) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d target = surface_point(near_u(random), k3), origin = target + 0.5 * random.normal3();
      const Vector3d direction = target - origin;
      const RayHits hits = ray_hits(origin, direction, k3);
      ASSERT_GE(hits.count, 1);
      double nearest = 1.0;
      for (int h = 0; h < hits.count; ++h) {
        EXPECT_GT(hits.s[h], 0.0);
        EXPECT_NEAR(implicit(origin + hits.s[h] * direction, k3), 0.0, 1e-12);
        nearest = std::min(nearest, std::abs(hits.s[h] - 1.0));
      }
      EXPECT_LT(nearest, 1e-9);  // the target is among them
      if (hits.count == 2) {
        ++twice;
        EXPECT_LT(hits.s[0], hits.s[1]);
      }
    }
  }
  EXPECT_GT(twice, 10);
}

TEST(RayHits, LieAheadAndOnTheModelledSheet) {
  const Vector3d sphere(-10, -10, -10);  // radius 0.1, centre at z = -0.1
  EXPECT_EQ(ray_hits({0, 0, 1}, {0, 0, 1}, sphere).count, 0);
  EXPECT_EQ(ray_hits({1, 0, 1}, {0, 0, -1}, sphere).count, 0);
  const RayHits down = ray_hits({0, 0, 1}, {0, 0, -2}, sphere);
  ASSERT_EQ(down.count, 1);  // the far half of the sphere is not part of the model
  EXPECT_NEAR(down.s[0], 0.5, 1e-15);
}

TEST(RayHits, OfARayAlongTheAxisOfAParaboloidAreOne) {
  const RayHits hits = ray_hits({0.1, 0.2, 1}, {0, 0, -1}, {3, 5, 0});
  ASSERT_EQ(hits.count, 1);
  EXPECT_NEAR(hits.s[0], 1.0 - height({0.1, 0.2}, {3, 5, 0}), 1e-15);
}

TEST(RayHits, OfAPlane) {
  EXPECT_EQ(ray_hits({0, 0, 1}, {1, 0, 0}, Vector3d::Zero()).count, 0);
  const RayHits hits = ray_hits({0, 0, 1}, {1, 0, -0.5}, Vector3d::Zero());
  ASSERT_EQ(hits.count, 1);
  EXPECT_NEAR(hits.s[0], 2.0, 1e-15);
}

}  // namespace
}  // namespace patchlab::test
