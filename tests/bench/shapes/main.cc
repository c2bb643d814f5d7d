// shapes_bench [--page FILE]: fits of planes, spheres and circular cylinders, beside PCL's sample consensus
// on the same points.
#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/base/random.h"
#include "engine/fit/fit_surface.h"
#include "engine/fit/initial_surface.h"
#include "engine/pose/rotation.h"
#include "engine/sensor/noise_model.h"
#include "tests/bench/round_robin/round_robin.h"
#include "tests/bench/shapes/pcl_shapes.h"

namespace patchlab::bench {
namespace {

constexpr double radius = 0.15;  // m, of spheres and cylinders
constexpr double extent = 0.1;   // m, radius of what is seen of them
constexpr int patches = 16;

struct Kind {
  Shape shape;
  ModelKind model;
  const char* words;
};
constexpr Kind kinds[] = {{Shape::plane, ModelKind::plane, "plane"},
                          {Shape::sphere, ModelKind::sphere, "sphere"},
                          {Shape::cylinder, ModelKind::circular_cylinder, "circular cylinder"}};

// From its centre, which lies behind the surface.
Vector3d normal_at(Shape shape, const Vector2d& u) {
  if (shape == Shape::plane) return Vector3d::UnitZ();
  const double x = shape == Shape::cylinder ? 0.0 : u.x();
  return Vector3d(x, u.y(), std::sqrt(radius * radius - x * x - u.y() * u.y())) / radius;
}

struct Seen {
  Observations observations;
  std::vector<Vector3d> normals;  // without noise
};

Seen one_patch(Random& random, const NoiseModel& kinect, Shape shape, std::size_t points) {
  const Vector3d c(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.9, 1.1));
  const Vector3d z = (-c.normalized() + 0.4 * random.unit3()).normalized();
  const Matrix3d R =
      shortest_turn(Vector3d::UnitZ(), z) * exp_map({0.0, 0.0, random.uniform(0.0, 2.0 * std::numbers::pi)});
  Seen seen;
  while (seen.observations.size() < points) {
    const Vector2d u(random.uniform(-extent, extent), random.uniform(-extent, extent));
    if (u.norm() > extent) continue;
    const Vector3d n = normal_at(shape, u);
    const double height = shape == Shape::plane ? 0.0 : radius * (n.z() - 1.0);
    const Vector3d q = c + R * Vector3d(u.x(), u.y(), height);
    const Matrix3d cov = covariance_in_sensor(kinect, q);
    seen.observations.points.push_back(q + cov.llt().matrixL() * random.normal3());
    seen.observations.covariances.push_back(cov);
    seen.normals.emplace_back(R * n);
  }
  return seen;
}

struct Fitted {
  double curvature;  // the largest, 1/m
  ChartMatrix cov;
};

Fitted fit(const Samples& samples, ModelKind kind) {
  const SurfaceModel model = surface_model(kind);
  const SurfaceState plane = initial_plane(samples);
  const SurfaceFit found =
      kind == ModelKind::plane
          ? fit_surface(samples, model, plane, {})
          : fit_surface(samples, model, starts(samples, model, height_field(samples, plane)), {});
  return {found.state.k.cwiseAbs().maxCoeff(), chart_covariance(found)};
}

// Fits of all patches of a kind, one after the other: that of one is a 16th.
std::string line(const Kind& kind, const NoiseModel& kinect) {
  std::string text = "| " + std::string(kind.words) + " |";
  for (const std::size_t points : {150U, 1500U}) {
    Random random(8);
    std::vector<Samples> samples;
    std::vector<PclPoints> clouds;
    for (int i = 0; i < patches; ++i) {
      const Seen seen = one_patch(random, kinect, kind.shape, points);
      samples.push_back(*make_samples(seen.observations, 10));
      clouds.emplace_back(seen.observations.points, seen.normals);
    }
    double error_ours = 0.0, error_pcl = 0.0;  // mm
    const double curvature = kind.shape == Shape::plane ? 0.0 : 1.0 / radius;
    RoundRobin times(21);
    times.add("ours", [&] {
      error_ours = 0.0;
      for (const Samples& one : samples)
        error_ours += std::abs(fit(one, kind.model).curvature - curvature) * radius * radius * 1e3 / patches;
    });
    times.add("PCL", [&] {
      error_pcl = 0.0;
      for (const PclPoints& one : clouds) error_pcl += std::abs(one.fit(kind.shape) - radius) * 1e3 / patches;
    });
    times.run();
    const auto one = [&](const std::string& name) {
      return bench::text("%.1f µs", 1e3 * times.median_ms(name) / patches) +
             bench::text(" ±%.0f %%", 100.0 * times.spread(name));
    };
    text += " " + one("ours") + " | " + one("PCL") + ", " + ratio_of(times, "PCL", "ours") + " |";
    text += kind.shape == Shape::plane
                ? std::string(" |")
                : bench::text(" %.1f,", error_ours) + bench::text(" %.1f |", error_pcl);
  }
  return text + "\n";
}

}  // namespace
}  // namespace patchlab::bench

int main(int argc, char** argv) {
  using namespace patchlab::bench;
  const patchlab::NoiseModel kinect = *patchlab::noise_model("kinect1");
  std::string text =
      date_and_machine() +
      ". Medians of processor time of one fit, half of the middle half as ±. Ours: start, weighted fit, "
      "covariance. PCL: `RandomSampleConsensus` and `optimizeModelCoefficients`, no covariance; normals for its "
      "cylinders are given. Mean errors of the radius, 150 mm, ours and PCL's.\n\n"
      "| shape | ours, 150 points | PCL | errors, mm | ours, 1500 points | PCL | errors, mm |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Kind& kind : kinds) text += line(kind, kinect);
  return report(argc, argv, "shapes", text);
}
