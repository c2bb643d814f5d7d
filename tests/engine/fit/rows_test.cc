// The kernels of the innermost loop against one sample at a time, in the words of the paper.
#include <gtest/gtest.h>

#include "engine/fit/sample_rows.h"
#include "engine/patch/surface.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using test::SeededRandom;

constexpr std::size_t points = 150;  // the last block is not full
constexpr ModelKind kinds[] = {ModelKind::plane,
                               ModelKind::sphere,
                               ModelKind::circular_cylinder,
                               ModelKind::circular_paraboloid,
                               ModelKind::cylindric_paraboloid,
                               ModelKind::paraboloid};

// Noisy points of a surface in a random place.
struct Scene {
  SurfaceState state;
  Observations observations;
  Samples samples;

  Scene(Random& random, const SurfaceModel& model) {
    state.k = {random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0)};
    state.R = exp_map(random.normal3());
    state.c = 0.05 * random.normal3();
    const Vector3d kappa = k3(model, state.k);
    for (std::size_t i = 0; i < points; ++i) {
      const Vector2d u(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
      const Vector3d off(0.0, 0.0, 0.004 * random.normal());
      Matrix3d L = 1e-3 * Matrix3d::Identity();
      for (double& entry : L.reshaped()) entry += 5e-4 * random.normal();
      observations.points.push_back(state.c + state.R * (surface_point(u, kappa) + off));
      observations.covariances.push_back(L * L.transpose());
    }
    samples = *make_samples(observations, 10);
    state.c -= samples.origin;
  }
};

std::vector<const RowKernel*> kernels() {
  std::vector<const RowKernel*> all = {&plain_rows()};
  for (const RowKernel* kernel : {avx2_rows(), avx512_rows()}) {
    if (kernel != nullptr) all.push_back(kernel);
  }
  return all;
}

template <class What>
void for_each_scene(What&& what) {
  SeededRandom random;
  for (const ModelKind kind : kinds) {
    const SurfaceModel& model = surface_model(kind);
    for (int trial = 0; trial < 10; ++trial) {
      const Scene scene(random, model);
      for (const Distance distance : {Distance::exact, Distance::paper}) what(scene, model, distance);
    }
  }
}

TEST(Rows, EveryKernelAgreesWithTheResidualOfEachSample) {
  for_each_scene([](const Scene& scene, const SurfaceModel& model, Distance distance) {
    for (const RowKernel* kernel : kernels()) {
      const SampleRows rows(scene.samples, model, scene.state, distance, *kernel);
      for_each_residual(rows, [&](std::size_t i, const Residual& fast) {
        const Residual r = residual(distance, model, scene.state, scene.samples.q(i), scene.samples.cov(i));
        EXPECT_NEAR(fast.F, r.F, 1e-12 * std::max(1.0, std::abs(r.F))) << kernel->name;
        EXPECT_LE((fast.F_p - r.F_p).norm(), 1e-12 * r.F_p.norm()) << kernel->name;
        EXPECT_LE((fast.F_q - r.F_q).norm(), 1e-12 * r.F_q.norm()) << kernel->name;
        EXPECT_LE((fast.x - r.x).norm(), 1e-12) << kernel->name;
        EXPECT_NEAR(fast.v, r.v, 1e-12 * r.v) << kernel->name;
      });
    }
  });
}

NormalEquations equations_by(const RowKernel& kernel, const Scene& scene, const SurfaceModel& model,
                             Distance distance) {
  const SampleRows rows(scene.samples, model, scene.state, distance, kernel);
  RowSums sums;
  RowBlock block;
  for (std::size_t b = 0; b < rows.blocks(); ++b) {
    rows.evaluate(b, block);
    rows.add(block, b, model.free_indices(), sums);
  }
  return normal_equations(sums, model.free_size);
}

TEST(Rows, SumsOfEveryKernelAreThoseOfThePlainOne) {
  for_each_scene([](const Scene& scene, const SurfaceModel& model, Distance distance) {
    const NormalEquations plain = equations_by(plain_rows(), scene, model, distance);
    for (const RowKernel* kernel : kernels()) {
      const NormalEquations fast = equations_by(*kernel, scene, model, distance);
      EXPECT_LE((fast.A - plain.A).norm(), 1e-12 * plain.A.norm()) << kernel->name;
      EXPECT_LE((fast.b - plain.b).norm(), 1e-12 * std::sqrt(plain.A.norm() * plain.chi2)) << kernel->name;
      EXPECT_NEAR(fast.chi2, plain.chi2, 1e-12 * plain.chi2) << kernel->name;
    }
  });
}

TEST(Rows, KernelsThatFuseGiveTheSameBytes) {
  if (avx2_rows() == nullptr || avx512_rows() == nullptr) GTEST_SKIP() << "one of them at most runs here";
  for_each_scene([](const Scene& scene, const SurfaceModel& model, Distance distance) {
    const NormalEquations narrow = equations_by(*avx2_rows(), scene, model, distance);
    const NormalEquations wide = equations_by(*avx512_rows(), scene, model, distance);
    EXPECT_EQ(narrow.A, wide.A);
    EXPECT_EQ(narrow.b, wide.b);
    EXPECT_EQ(narrow.chi2, wide.chi2);
  });
}

// Footnote 10: where the noise of a sample has no extent along the normal, its weight stays finite.
TEST(Rows, CovariancesWithoutExtentAreClampedByEveryKernel) {
  SeededRandom random;
  const SurfaceModel& plane = surface_model(ModelKind::plane);
  Scene scene(random, plane);
  const Vector3d x = scene.state.R.col(0);
  for (const std::size_t i : {std::size_t{3}, points - 1}) scene.samples.set_cov(i, 1e-6 * x * x.transpose());
  for (const RowKernel* kernel : kernels()) {
    const SampleRows rows(scene.samples, plane, scene.state, Distance::paper, *kernel);
    for_each_residual(rows, [&](std::size_t i, const Residual& fast) {
      const double v =
          residual(Distance::paper, plane, scene.state, scene.samples.q(i), scene.samples.cov(i)).v;
      EXPECT_NEAR(fast.v, v, 1e-9 * v) << kernel->name;
    });
  }
}

TEST(Rows, SumsAreThoseOfAllSamples) {
  for_each_scene([](const Scene& scene, const SurfaceModel& model, Distance distance) {
    const SampleRows rows(scene.samples, model, scene.state, distance);
    const auto n = static_cast<Eigen::Index>(model.free_size);
    StepMatrix A = StepMatrix::Zero(n, n);
    StepVector b = StepVector::Zero(n);
    double chi2 = 0.0;
    RowSums sums;
    RowBlock block;
    for (std::size_t at = 0; at + 1 < rows.blocks(); ++at) {  // whole blocks: nothing to leave out
      rows.evaluate(at, block);
      rows.add(block, at, model.free_indices(), sums);
      for (std::size_t i = 0; i < rows.count(at); ++i) {
        const Residual r = rows.residual(block, i);
        const StepVector F_p = reduced(model, r.F_p);
        A += F_p * F_p.transpose();
        b += r.F * F_p;
        chi2 += r.F * r.F;
      }
    }
    const NormalEquations equations = normal_equations(sums, model.free_size);
    EXPECT_LE((equations.A - A).norm(), 1e-13 * A.norm());
    EXPECT_LE((equations.b - b).norm(), 1e-12 * std::sqrt(A.norm() * chi2));
    EXPECT_NEAR(equations.chi2, chi2, 1e-13 * chi2);
  });
}

// The centre of a sphere, whose gradient is 0, and a sample whose noise lies along the surface.
TEST(Rows, WhereAKernelFindsNoFootPointTheBracketedSearchAnswers) {
  SeededRandom random;
  const SurfaceModel& sphere = surface_model(ModelKind::sphere);
  Scene scene(random, sphere);
  scene.state.k = {4.0, 0.0};
  const std::size_t centre = 5, along = 6;
  scene.observations.points[centre] = scene.samples.origin + scene.state.c + 0.25 * scene.state.R.col(2);
  scene.observations.points[along] = scene.samples.origin + scene.state.c + 0.01 * scene.state.R.col(2);
  const Vector3d x = scene.state.R.col(0);
  const Vector3d origin = scene.samples.origin;
  scene.observations.covariances[along] = 1e-6 * x * x.transpose();
  scene.samples = *make_samples(scene.observations, 10);
  scene.state.c += origin - scene.samples.origin;
  for (const RowKernel* kernel : kernels()) {
    const SampleRows rows(scene.samples, sphere, scene.state, Distance::exact, *kernel);
    RowBlock block;
    rows.evaluate(0, block);
    for (const std::size_t i : {centre, along}) {
      const Residual r =
          residual(Distance::exact, sphere, scene.state, scene.samples.q(i), scene.samples.cov(i));
      EXPECT_NE(block.failed[i], 0.0) << i;
      EXPECT_EQ(rows.residual(block, i).F, r.F) << i;
      EXPECT_EQ(rows.residual(block, i).x, r.x) << i;
    }
  }
}

TEST(Rows, ReevaluatedNoiseReachesTheKernels) {
  SeededRandom random;
  const SurfaceModel& plane = surface_model(ModelKind::plane);
  Scene scene(random, plane);
  for (const std::size_t i : {std::size_t{3}, points - 1})
    scene.samples.set_cov(i, 1e-5 * Matrix3d::Identity());
  const SampleRows rows(scene.samples, plane, scene.state, Distance::paper);
  for_each_residual(rows, [&](std::size_t i, const Residual& fast) {
    EXPECT_NEAR(fast.v,
                residual(Distance::paper, plane, scene.state, scene.samples.q(i), scene.samples.cov(i)).v,
                1e-12 * fast.v);
  });
}

}  // namespace
}  // namespace patchlab
