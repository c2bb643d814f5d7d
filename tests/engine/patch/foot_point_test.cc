#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/patch/surface.h"
#include "tests/support/monte_carlo.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

using std::numbers::pi;

const std::vector<Vector3d> surfaces = {{3, 5, 0}, {-3, -5, 0}, {-3, 5, 0},   {0, 4, 0}, {4, 4, 0},
                                        {0, 0, 0}, {4, 4, 4},   {-4, -4, -4}, {0, 4, 4}, {0, -4, -4}};

double squared_mahalanobis(const Vector3d& difference, const Matrix3d& cov) {
  return difference.dot(cov.llt().solve(difference));
}

// Every point of the quadric from two parameters in [-1, 1]: both halves of spheres and cylinders, and
// paraboloids as far as 1 m.
Vector3d quadric_point(const Vector2d& s, const Vector3d& k3) {
  if (k3.z() == 0.0) return surface_point(s, k3);
  const double radius = 1.0 / k3.z(), a = pi * s.y();
  if (k3.x() == 0.0) return {s.x(), radius * std::sin(a), radius * (1.0 - std::cos(a))};
  const double b = 0.5 * pi * (s.x() + 1.0);
  return {radius * std::sin(b) * std::cos(a), radius * std::sin(b) * std::sin(a),
          radius * (1.0 - std::cos(b))};
}

// The least squared distance by a grid that closes in on its best point.
double brute_force(const Vector3d& q, const Matrix3d& cov, const Vector3d& k3) {
  const Matrix3d information = cov.llt().solve(Matrix3d::Identity());
  Vector2d best = Vector2d::Zero();
  double least = 1e300, half = 1.0;
  for (int round = 0; round < 12; ++round, half *= 0.15) {
    const int cells = round == 0 ? 150 : 30;
    const Vector2d middle = best;
    for (int i = -cells; i <= cells; ++i) {
      for (int j = -cells; j <= cells; ++j) {
        const Vector2d s = middle + half / cells * Vector2d(i, j);
        const Vector3d difference = q - quadric_point(s, k3);
        const double squared = difference.dot(information * difference);
        if (squared < least) least = squared, best = s;
      }
    }
  }
  return least;
}

Matrix3d covariance_with(Random& random, const Vector3d& sigmas) {
  const Matrix3d R = exp_map(random.normal3());
  return R * sigmas.cwiseProduct(sigmas).asDiagonal() * R.transpose();
}

TEST(FootPoint, IsOnTheSurfaceAndStationary) {
  SeededRandom random;
  for (const Vector3d& k3 : surfaces) {
    for (int i = 0; i < 100; ++i) {
      const Matrix3d S = covariance_with(random, {0.0005, 0.0005, random.uniform(0.0005, 0.02)});
      const Vector2d u(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15));
      const Vector3d q = surface_point(u, k3) + 0.01 * random.normal3();
      const FootPoint foot = foot_point(q, S, k3);
      EXPECT_NEAR(implicit(foot.x, k3), 0.0, 1e-12);
      const Vector3d along = S * gradient(foot.x, k3), offset = q - foot.x;
      EXPECT_LT(offset.cross(along).norm(), 1e-9 * offset.norm() * along.norm() + 1e-18);
      EXPECT_NEAR(foot.distance * foot.distance / squared_mahalanobis(offset, S), 1.0, 1e-8);
    }
  }
}

TEST(FootPoint, NoPointOfTheSurfaceIsNearer) {
  SeededRandom random;
  for (const Vector3d& k3 : surfaces) {
    for (int i = 0; i < 4; ++i) {
      const Matrix3d S = covariance_with(random, {0.05, 0.1, 0.2});
      const Vector3d q = 0.25 * random.normal3();
      const double squared = std::pow(foot_point(q, S, k3).distance, 2);
      EXPECT_NEAR(squared, brute_force(q, S, k3), 1e-9 * (1.0 + squared)) << "k3 " << k3.transpose();
    }
  }
}

TEST(FootPoint, DistanceIsSignedNegativeOnTheOuterSideOfG) {
  for (const Vector3d& k3 : surfaces) {
    const double outer = foot_point({0, 0, 0.01}, Matrix3d::Identity(), k3).distance;
    const double inner = foot_point({0, 0, -0.01}, Matrix3d::Identity(), k3).distance;
    EXPECT_NEAR(outer, -0.01, 1e-15);
    EXPECT_NEAR(inner, 0.01, 1e-15);
  }
}

TEST(FootPoint, OfAPointOnTheSurfaceIsThePoint) {
  SeededRandom random;
  for (const Vector3d& k3 : surfaces) {
    const Vector3d q = surface_point({0.1, -0.05}, k3);
    const FootPoint foot = foot_point(q, covariance_with(random, {1e-3, 1e-3, 1e-2}), k3);
    EXPECT_LT((foot.x - q).norm(), 1e-15);
    EXPECT_NEAR(foot.distance, 0.0, 1e-12);
  }
}

TEST(FootPoint, DerivativeOfTheDistanceIsThatOfTheEnvelopeTheorem) {
  SeededRandom random;
  for (const Vector3d& k3 : surfaces) {
    const Matrix3d S = covariance_with(random, {0.01, 0.01, 0.03});
    const Vector3d q = surface_point({0.1, -0.05}, k3) + 0.01 * random.normal3();
    const Vector3d g = gradient(foot_point(q, S, k3).x, k3);
    const auto F = [&](const VectorXd& x) -> VectorXd {
      return VectorXd::Constant(1, foot_point(x, S, k3).distance);
    };
    EXPECT_TRUE(
        jacobian_matches(g.transpose() / std::sqrt(g.dot(S * g)), F, q, {.step = 1e-4, .tolerance = 1e-9}));
  }
}

TEST(FootPoint, DoesNotDependOnTheScaleOfTheCovariance) {
  SeededRandom random;
  for (const Vector3d& k3 : surfaces) {
    const Matrix3d S = covariance_with(random, {0.001, 0.002, 0.01});
    const Vector3d q = surface_point({0.1, -0.05}, k3) + 0.02 * random.normal3();
    const FootPoint foot = foot_point(q, S, k3);
    for (const double scale : {1e-14, 1e-6, 1e8}) {
      const FootPoint scaled = foot_point(q, scale * S, k3);
      EXPECT_LT((scaled.x - foot.x).norm(), 1e-11);
      EXPECT_NEAR(scaled.distance * std::sqrt(scale), foot.distance, 1e-8 * std::abs(foot.distance));
    }
  }
}

TEST(FootPoint, NeedsFewIterationsOnRangeData) {
  SeededRandom random;
  for (const Vector3d& k3 : surfaces) {
    for (int i = 0; i < 300; ++i) {
      const Vector3d ray = (Vector3d::UnitZ() + 0.5 * random.normal3()).normalized();
      const Matrix3d S = 4e-7 * Matrix3d::Identity() + 1.8e-5 * ray * ray.transpose();  // a Kinect at 1 m
      const Vector2d u(random.uniform(-0.12, 0.12), random.uniform(-0.12, 0.12));
      const Vector3d q = surface_point(u, k3) + S.llt().matrixL() * random.normal3();
      EXPECT_LE(foot_point(q, S, k3).iterations, 8);
    }
  }
}

TEST(FootPoint, FollowsTheRayWhereOnlyTheRangeIsUncertain) {
  SeededRandom random;
  for (const Vector3d& k3 : surfaces) {
    const Vector3d target = surface_point({0.05, 0.08}, k3);
    const Vector3d ray = (Vector3d::UnitZ() + 0.3 * random.normal3()).normalized();
    const FootPoint foot = foot_point(target + 0.003 * ray, 1e-4 * ray * ray.transpose(), k3);
    EXPECT_LT((foot.x - target).norm(), 1e-10);
    EXPECT_NEAR(std::abs(foot.distance), 0.3, 1e-8);
  }
}

TEST(FootPoint, OfARayThatMissesIsInfinitelyFar) {
  const Vector3d sphere(4, 4, 4);
  const Matrix3d sideways = Vector3d(1, 0, 0).asDiagonal();
  const FootPoint foot = foot_point({0, 0, -0.1}, sideways, sphere);
  EXPECT_TRUE(std::isinf(foot.distance));
  EXPECT_GT(foot.distance, 0.0);
  EXPECT_TRUE(foot.x.allFinite());
  EXPECT_TRUE(std::isinf(foot_point({0, 0, 0.1}, Matrix3d::Zero(), sphere).distance));
}

// At a centre of curvature, and beyond it on an axis of symmetry, several points are equally near.
TEST(FootPoint, ChoosesOneOfSeveralEquallyNearPoints) {
  struct Tie {
    Vector3d q, k3;
    double distance;
  };
  const std::vector<Tie> ties = {
      {{0, 0, 0.25}, {4, 4, 4}, 0.25},                        // the centre of a sphere
      {{3, 0, 0.25}, {0, 4, 4}, 0.25},                        // the axis of a cylinder
      {{0, 0, 0.4}, {3, 5, 0}, std::sqrt(0.4 * 0.4 - 0.04)},  // (2 k h - 1) / k^2 for k = 5
      {{1, 0, 0.4}, {0, 5, 0}, std::sqrt(0.4 * 0.4 - 0.04)},
  };
  for (const Tie& tie : ties) {
    const FootPoint foot = foot_point(tie.q, Matrix3d::Identity(), tie.k3);
    EXPECT_NEAR(implicit(foot.x, tie.k3), 0.0, 1e-9);
    EXPECT_NEAR((tie.q - foot.x).norm(), tie.distance, 1e-6) << tie.q.transpose();
    EXPECT_NEAR(std::abs(foot.distance), tie.distance, 1e-6);
  }
}

TEST(FootPoint, OfPointsNextToACentreOfCurvatureIsRight) {
  SeededRandom random;
  const Vector3d sphere(4, 4, 4), centre(0, 0, 0.25);
  for (const double away : {1e-3, 1e-6, 1e-9}) {
    const Vector3d direction = random.unit3();
    const FootPoint foot = foot_point(centre + away * direction, Matrix3d::Identity(), sphere);
    EXPECT_NEAR(std::abs(foot.distance), 0.25 - away, 1e-7);
  }
}

TEST(FootPoint, OfFarPointsIsRight) {
  for (const double far : {10.0, 1e3}) {
    const Vector3d q = far * Vector3d(0.6, 0, 0.8), sphere(-4, -4, -4);
    const FootPoint foot = foot_point(q, Matrix3d::Identity(), sphere);
    const Vector3d centre(0, 0, -0.25), expected = centre + 0.25 * (q - centre).normalized();
    EXPECT_LT((foot.x - expected).norm(), 1e-9 + 1e-12 * far);
  }
}

}  // namespace
}  // namespace patchlab::test
