// The kernels of the joint covariance against one sample at a time, in the words of the paper.
#include <gtest/gtest.h>

#include "engine/fit/moment_sums.h"
#include "engine/patch/surface.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using test::SeededRandom;

constexpr std::size_t sample_count = 150;  // the last block is not full

// Noisy points of a surface in a random place before a camera; some count less, or not at all, or for the
// outline alone.
struct WeighedScene {
  SurfaceFit fit;
  Observations observations;
  Samples samples;

  WeighedScene(Random& random, const SurfaceModel& model) {
    fit.model = model;
    fit.state.k = {random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0)};
    fit.state.R = exp_map(random.normal3());
    fit.state.c = 0.05 * random.normal3();
    const Vector3d towards = random.unit3();
    observations.viewpoint = fit.state.c - random.uniform(0.5, 2.0) * towards;
    observations.optical_axis = (towards + 0.3 * random.unit3()).normalized();
    const Vector3d kappa = k3(model, fit.state.k);
    for (std::size_t i = 0; i < sample_count; ++i) {
      const Vector2d u(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
      const Vector3d off(0.0, 0.0, 0.004 * random.normal());
      Matrix3d L = 1e-3 * Matrix3d::Identity();
      for (double& entry : L.reshaped()) entry += 5e-4 * random.normal();
      observations.points.push_back(fit.state.c + fit.state.R * (surface_point(u, kappa) + off));
      observations.covariances.push_back(L * L.transpose());
    }
    samples = *make_samples(observations, 10);
    fit.state.c -= samples.origin;
    for (std::size_t i = 0; i < sample_count; i += 3)
      samples.robust[i] = i % 2 == 0 ? random.uniform(0.0, 1.0) : 0.0;
    for (std::size_t i = 0; i < sample_count; i += 7) samples.bends[i] = 0;
  }
};

std::vector<const MomentKernel*> moment_kernels() {
  std::vector<const MomentKernel*> all = {&plain_moment_rows()};
  for (const MomentKernel* kernel : {avx2_moment_rows(), avx512_moment_rows()}) {
    if (kernel != nullptr) all.push_back(kernel);
  }
  return all;
}

const JointOptions of_feet{}, of_samples{Distance::paper, Projection::plain, false, nullptr};

template <class What>
void for_each_weighed_scene(What&& what) {
  SeededRandom random;
  for (const ModelKind kind :
       {ModelKind::plane, ModelKind::sphere, ModelKind::circular_cylinder, ModelKind::circular_paraboloid,
        ModelKind::cylindric_paraboloid, ModelKind::paraboloid}) {
    for (int trial = 0; trial < 10; ++trial) {
      const WeighedScene scene(random, surface_model(kind));
      for (const JointOptions& options : {of_feet, of_samples}) what(scene, options);
    }
  }
}

// What a bound may ask for: the free part of the chart, and the moments, with z only of spheres and
// cylinders.
std::vector<int> asked_for(const SurfaceFit& fit) {
  std::vector<int> all(fit.model.free_indices().begin(), fit.model.free_indices().end());
  const bool with_z = k3(fit.model, fit.state.k).z() != 0.0;
  for (int moment = 0; moment < moments_size; ++moment) {
    const bool is_of_z = moment == 2 || moment == 5 || moment >= 7;
    if (with_z || !is_of_z) all.push_back(moments_at + moment);
  }
  return all;
}

void expect_alike(const JointSums& fast, const JointSums& each, const SurfaceFit& fit, const char* kernel) {
  const std::vector<int> indices = asked_for(fit);
  for (const int i : indices) {
    for (const int j : indices) {
      if (j > i) continue;
      const double scale = std::sqrt(each.G(i, i) * each.G(j, j));
      EXPECT_NEAR(fast.G(i, j), each.G(i, j), 1e-12 * scale) << kernel << " G " << i << ", " << j;
      if (i < moments_at || j >= chart_size) continue;
      const int row = i - moments_at;
      const double size = each.M.row(row).cwiseAbs().maxCoeff() * each.M.col(j).cwiseAbs().maxCoeff() /
                          each.M.cwiseAbs().maxCoeff();
      EXPECT_NEAR(fast.M(row, j), each.M(row, j), 1e-12 * std::max(size, std::abs(each.M(row, j))))
          << kernel << " M " << row << ", " << j;
    }
  }
}

TEST(MomentRows, SumsOfEveryKernelAreThoseOfOneSampleAtATime) {
  for_each_weighed_scene([](const WeighedScene& scene, const JointOptions& options) {
    for (const MomentKernel* kernel : moment_kernels()) {
      const ProjectedSamples fast = project(scene.samples, scene.fit, options, *kernel);
      const MomentVector m = moments(fast.feet.x, fast.feet.weight);
      for (const int i : asked_for(scene.fit)) {
        if (i < moments_at) continue;
        EXPECT_NEAR(fast.moments[i - moments_at], m[i - moments_at], 1e-12 * m.cwiseAbs().maxCoeff())
            << kernel->name;
      }
      const JointSums each = joint_sums(scene.samples, scene.fit, fast.feet, options);
      expect_alike(fast.sums, each, scene.fit, kernel->name);
    }
  });
}

TEST(MomentRows, FootPointsOfEveryKernelAreThoseOfOneSampleAtATime) {
  for_each_weighed_scene([](const WeighedScene& scene, const JointOptions& options) {
    const Samples& samples = scene.samples;
    std::vector<double> weight(sample_count);
    double sum = 0.0;
    const auto residual_of = [&](std::size_t i) {
      return residual(options.distance, scene.fit.model, scene.fit.state, samples.q(i), samples.cov(i));
    };
    for (std::size_t i = 0; i < sample_count; ++i) {
      const bool feet = options.distance == Distance::exact;
      weight[i] = feet ? footprint(samples, scene.fit.state, i, residual_of(i)) : samples.robust[i] > 0.0;
      sum += weight[i];
    }
    for (const MomentKernel* kernel : moment_kernels()) {
      const FootPoints fast = project(samples, scene.fit, options, *kernel).feet;
      for (std::size_t i = 0; i < sample_count; ++i) {
        const Residual r = residual_of(i);
        EXPECT_NEAR(fast.weight[i], weight[i] / sum, 1e-12 * weight[i] / sum) << kernel->name;
        EXPECT_LE((fast.x[i] - r.x).norm(), 1e-12) << kernel->name;
        EXPECT_NEAR(fast.F[i], r.F, 1e-12 * std::max(1.0, std::abs(r.F))) << kernel->name;
      }
    }
  });
}

// Merged clouds: a sensor position a point.
TEST(MomentRows, FootprintsAskForEachPointsOwnViewpoint) {
  SeededRandom random;
  WeighedScene scene(random, surface_model(ModelKind::paraboloid));
  scene.observations.viewpoints.assign(sample_count, scene.observations.viewpoint);
  const FootPoints same = project(scene.samples, scene.fit, of_feet).feet;
  scene.observations.viewpoints.clear();
  const FootPoints one = project(scene.samples, scene.fit, of_feet).feet;
  for (std::size_t i = 0; i < sample_count; ++i)
    EXPECT_NEAR(same.weight[i], one.weight[i], 1e-12 * one.weight[i]);
}

// Footnote 10: where a variance was clamped, its sample counts for less in the sums of the fit.
TEST(MomentRows, CovariancesWithoutExtentCountByTheirShare) {
  SeededRandom random;
  WeighedScene scene(random, surface_model(ModelKind::paraboloid));
  const Vector3d x = scene.fit.state.R.col(0);
  for (const std::size_t i : {std::size_t{4}, sample_count - 2})
    scene.samples.set_cov(i, 1e-6 * x * x.transpose());
  for (const MomentKernel* kernel : moment_kernels()) {
    const ProjectedSamples fast = project(scene.samples, scene.fit, of_samples, *kernel);
    const JointSums each = joint_sums(scene.samples, scene.fit, fast.feet, of_samples);
    expect_alike(fast.sums, each, scene.fit, kernel->name);
  }
}

TEST(MomentRows, KernelsThatFuseGiveTheSameBytes) {
  if (avx2_moment_rows() == nullptr || avx512_moment_rows() == nullptr)
    GTEST_SKIP() << "one of them at most runs here";
  for_each_weighed_scene([](const WeighedScene& scene, const JointOptions& options) {
    const ProjectedSamples narrow = project(scene.samples, scene.fit, options, *avx2_moment_rows());
    const ProjectedSamples wide = project(scene.samples, scene.fit, options, *avx512_moment_rows());
    EXPECT_EQ(narrow.sums.G, wide.sums.G);
    EXPECT_EQ(narrow.sums.M, wide.sums.M);
    EXPECT_EQ(narrow.moments, wide.moments);
    EXPECT_EQ(narrow.feet.weight, wide.feet.weight);
  });
}

}  // namespace
}  // namespace patchlab
