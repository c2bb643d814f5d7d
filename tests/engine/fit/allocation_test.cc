// A surface fit takes nothing from the heap, however many points it has: counted, in a program of its own.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/fit/fit_model.h"
#include "tests/support/battery.h"
#include "tests/support/seeded_random.h"

namespace {

std::atomic<std::size_t> taken = 0;

}  // namespace

extern "C" void* __real_malloc(std::size_t size);
extern "C" void* __wrap_malloc(std::size_t size) {
  ++taken;
  return __real_malloc(size);
}
void* operator new(std::size_t size) {
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++taken;
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace patchlab {
namespace {

Observations paraboloid(std::size_t points) {
  test::SeededRandom random;
  test::ScenarioOptions options;
  options.points = points;
  const PatchTypeRow& type = *find_patch_type(SurfaceType::elliptic_paraboloid, BoundaryType::ellipse);
  return test::observe(random, test::random_scenario(random, type, true, options), options);
}

TEST(Allocation, IsCounted) {
  const std::size_t before = taken;
  const auto one = std::make_unique<int>(1);
  const Eigen::VectorXd two = Eigen::VectorXd::Constant(40, *one);
  const std::vector<SampleBlock> three(1);
  EXPECT_EQ(taken - before, 3U) << two.sum() << three.size();
}

TEST(Allocation, SurfaceFitsTakeNothingFromTheHeap) {
  for_each_chunk(64, 1, [](const Chunk&) {});  // starts the threads, which takes something
  for (const std::size_t points : {30U, 150U, 3000U, 15000U}) {
    const Observations observations = paraboloid(points);
    Samples samples = *make_samples(observations, 10);
    const std::size_t before = taken;
    const SurfaceState plane = initial_plane(samples);
    const ModelStart start{quadratic_fit(samples, plane), {}};
    double trace = 0.0;
    for (const ModelKind kind :
         {ModelKind::plane, ModelKind::sphere, ModelKind::circular_cylinder, ModelKind::circular_paraboloid,
          ModelKind::cylindric_paraboloid, ModelKind::paraboloid}) {
      trace += chart_covariance(fit_model(samples, surface_model(kind), start)).trace();
    }
    SurfaceFitOptions paper;
    paper.distance = Distance::paper;
    trace += fit_surface(samples, surface_model(ModelKind::paraboloid), plane, paper).chi2;
    EXPECT_EQ(taken - before, 0U) << points << " points";
    EXPECT_GT(trace, 0.0);
  }
}

}  // namespace
}  // namespace patchlab
