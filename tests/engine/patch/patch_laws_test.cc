// Laws of shape that hold for every patch of Table I: points, containment, rays, area.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "engine/patch/patch.h"
#include "tests/engine/patch/example_patches.h"

namespace patchlab::test {
namespace {

class PatchLaws : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, PatchLaws, testing::ValuesIn(all_cases()), case_name);

class HalfSurfaceLaws : public PatchLaws {};
INSTANTIATE_TEST_SUITE_P(Table1, HalfSurfaceLaws, testing::ValuesIn(cases_where([](const PatchTypeRow& type) {
                           return type.surface == SurfaceType::sphere ||
                                  type.surface == SurfaceType::circular_cylinder;
                         })),
                         case_name);

double f_world(const Patch& patch, const Vector3d& q_world) {
  return implicit(apply_inverse(world_from_patch(patch), q_world), k3(patch));
}

TEST_P(PatchLaws, PartsOfTheParameterVectorAreWhatItWasMadeOf) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Patch again = make_patch(*patch.type, boundary(patch), curvatures(patch), axes(patch), centre(patch),
                                 patch.covariance_local);
  EXPECT_TRUE(same_patch(patch, again));
  EXPECT_EQ(patch.parameters.size(), GetParam().type->size());
  EXPECT_EQ(world_from_patch(patch).t, centre(patch));
  EXPECT_EQ(exp_map(world_from_patch(patch).r), axes(patch));
}

TEST_P(PatchLaws, ExamplesAreValid) {
  SeededRandom random;
  for (int i = 0; i < 10; ++i) {
    const Result<void> valid = validate(random_patch(random, GetParam()));
    EXPECT_TRUE(valid) << valid.error().message;
  }
}

TEST_P(PatchLaws, ExplicitPointsSatisfyTheImplicitFormAndAreContained) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  for (int i = 0; i < 100; ++i) {
    const Vector3d q = world_point(patch, random_u(random, patch));
    EXPECT_NEAR(f_world(patch, q), 0.0, 1e-14);
    EXPECT_TRUE(contains(patch, q));
  }
}

TEST_P(PatchLaws, ContainmentEndsAtTheOutline) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  for (const Vector2d& u : outline(boundary(patch), 40)) {
    EXPECT_TRUE(contains(patch, world_point(patch, 0.999 * u)));
    EXPECT_FALSE(contains(patch, world_point(patch, 1.001 * u)));
  }
}

TEST_P(HalfSurfaceLaws, TheOtherHalfIsNotContained) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  EXPECT_FALSE(contains(patch, apply(world_from_patch(patch), Vector3d(0, 0, 2.0 / k3(patch).z()))));
}

TEST_P(PatchLaws, RaysHitTheBoundedPatchWhereItIs) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  for (int i = 0; i < 100; ++i) {
    const Vector3d target = world_point(patch, random_u(random, patch)), origin = target + random.normal3();
    const std::optional<double> s = ray_hit(patch, origin, target - origin);
    ASSERT_TRUE(s);
    EXPECT_LE(*s, 1.0 + 1e-9);
    const Vector3d hit = origin + *s * (target - origin);
    EXPECT_NEAR(f_world(patch, hit), 0.0, 1e-12);
    EXPECT_LE(boundary_function(apply_inverse(world_from_patch(patch), hit).head<2>(), boundary(patch)),
              1e-12);
  }
}

TEST_P(PatchLaws, RaysPastTheOutlineOrAwayHitNothing) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Vector3d z = axes(patch).col(2);
  for (const Vector2d& u : outline(boundary(patch), 20)) {
    const Vector3d above = world_point(patch, 0.99 * u) + z, beside = world_point(patch, 1.01 * u) + z;
    EXPECT_TRUE(ray_hit(patch, above, -z));
    EXPECT_FALSE(ray_hit(patch, above, z));
    EXPECT_FALSE(ray_hit(patch, beside, -z));
  }
}

// Area element |g| / (2 (1 - kappa z)) over u = rho times the outline, each quarter of it by itself: no
// formula of engine/patch/area.cc.
double area_by_quadrature(const Patch& patch) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const Boundary bound = boundary(patch);
  const Vector3d k = k3(patch);
  const auto element = [&](const Vector2d& u) {
    const Vector3d n = gradient(surface_point(u, k), k);
    return n.norm() / std::abs(n.z());
  };
  const auto ring = [&](double s) {
    const Vector2d u = outline_point(bound, s).u;
    const double h = 1e-4;
    const Vector2d along = (8.0 * (outline_point(bound, s + h).u - outline_point(bound, s - h).u) -
                            (outline_point(bound, s + 2 * h).u - outline_point(bound, s - 2 * h).u)) /
                           (12.0 * h);
    const double swept = u.x() * along.y() - u.y() * along.x();
    return swept * Gauss::integrate([&](double rho) { return rho * element(rho * u); }, 0.0, 1.0);
  };
  double area = 0.0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    area += Gauss::integrate(ring, 0.25 * quarter, 0.25 * (quarter + 1));
  }
  return area;
}

TEST_P(PatchLaws, AreaIsTheIntegralOfTheAreaElement) {
  SeededRandom random;
  for (int i = 0; i < 5; ++i) {
    const Patch patch = random_patch(random, GetParam());
    EXPECT_NEAR(surface_area(patch) / area_by_quadrature(patch), 1.0, 1e-6);
  }
}

TEST_P(PatchLaws, AreaAgreesWithSampling) {
  SeededRandom random;
  const Patch patch = random_patch(random, GetParam());
  const Vector3d k = k3(patch);
  constexpr int count = 2000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double element = 1.0 / outward_normal(surface_point(random_u(random, patch), k), k).z();
    sum += element;
    squares += element * element;
  }
  const double mean = sum / count, sigma = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
  EXPECT_NEAR(surface_area(patch) / area(boundary(patch)), mean, 5.0 * sigma + 1e-12);
}

TEST(SurfaceArea, OfHemisphereHalfCylinderAndFlatPatchesIsThatOfTheTextbook) {
  const auto made = [](SurfaceType surface, double d_x, double d_y, double kappa) {
    const PatchTypeRow& type = *find_patch_type(surface, default_boundary(surface));
    Boundary bound{type.boundary, BoundaryVector(type.boundary_size)};
    bound.d << VectorXd(Vector2d(d_x, d_y)).head(type.boundary_size);
    return make_patch(type, bound, VectorXd::Constant(type.curvature_size, kappa), Matrix3d::Identity(),
                      Vector3d::Zero());
  };
  using std::numbers::pi;
  EXPECT_NEAR(surface_area(made(SurfaceType::sphere, 0.1, 0, -10)), 2 * pi * 0.01, 1e-9);
  EXPECT_NEAR(surface_area(made(SurfaceType::circular_cylinder, 0.3, 0.1, 10)), 0.6 * pi * 0.1, 1e-9);
  EXPECT_NEAR(surface_area(made(SurfaceType::circular_cylinder, 0.3, 0.1, 0)), 0.12, 1e-15);
  EXPECT_NEAR(surface_area(made(SurfaceType::cylindric_paraboloid, 0.3, 0.1, 0)), 0.12, 1e-15);
  EXPECT_NEAR(surface_area(made(SurfaceType::elliptic_paraboloid, 0.3, 0.1, 0)), pi * 0.03, 1e-15);
  EXPECT_NEAR(surface_area(made(SurfaceType::circular_paraboloid, 0.1, 0, 5)),
              2 * pi / 75 * (std::pow(1.25, 1.5) - 1), 1e-15);
}

}  // namespace
}  // namespace patchlab::test
