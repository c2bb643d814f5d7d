#include "tests/bench/grid/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/random.h"

namespace patchlab::bench {
namespace {

using Eigen::Vector3d;

struct Ball {
  Vector3d centre;
  double radius;
};
// x right, y down, z forward from a camera that looks down at 45 degrees.
const Vector3d ground_normal = Vector3d(0.0, -1.0, -1.0).normalized();
constexpr double camera_height = 0.75;

Ball boulder(double x, double forward, double radius, double above) {
  const Vector3d along = Vector3d(0.0, -1.0, 1.0).normalized();
  const Vector3d foot = -camera_height * ground_normal;
  return {foot + x * Vector3d::UnitX() + forward * along + (above - radius) * ground_normal, radius};
}
const std::vector<Ball> balls = {boulder(-0.25, 0.05, 0.15, 0.1), boulder(0.2, 0.15, 0.2, 0.12),
                                 boulder(0.0, -0.15, 0.08, 0.1),  boulder(0.45, -0.1, 0.12, 0.08),
                                 boulder(-0.5, 0.35, 0.25, 0.15), boulder(0.1, 0.6, 0.3, 0.2)};

struct Seen {
  double s = std::numeric_limits<double>::infinity();
  std::uint32_t object = 0;
  Vector3d normal = Vector3d::Zero();
};

// Along s * ray from the origin.
Seen look(const Vector3d& ray) {
  Seen seen;
  std::uint32_t object = 0;
  for (const Ball& ball : balls) {
    const double a = ray.squaredNorm(), b = ray.dot(ball.centre);
    const double under = b * b - a * (ball.centre.squaredNorm() - ball.radius * ball.radius);
    const double s = (b - std::sqrt(std::max(under, 0.0))) / a;
    if (under > 0.0 && s < seen.s) seen = {s, object, (s * ray - ball.centre).normalized()};
    ++object;
  }
  const double s = -camera_height / ground_normal.dot(ray);
  if (s > 0.0 && s < seen.s) seen = {s, object, ground_normal};
  if (seen.normal.dot(ray) > 0.0) seen.normal = -seen.normal;
  return seen;
}

// Spots without a return, as shine and darkness leave them.
void lose_spots(Scan& scan, std::uint64_t seed) {
  constexpr std::int64_t most_radius = 9;
  Random random(seed);
  const auto width = static_cast<std::int64_t>(scan.width), height = static_cast<std::int64_t>(scan.height);
  while (static_cast<double>(scan.finite_count) > 0.97 * static_cast<double>(scan.size())) {
    const auto x0 = static_cast<std::int64_t>(random.uniform(0.0, static_cast<double>(width)));
    const auto y0 = static_cast<std::int64_t>(random.uniform(0.0, static_cast<double>(height)));
    const double radius = random.uniform(0.5, static_cast<double>(most_radius));
    for (std::int64_t y = std::max<std::int64_t>(0, y0 - most_radius); y < std::min(height, y0 + most_radius);
         ++y) {
      for (std::int64_t x = std::max<std::int64_t>(0, x0 - most_radius);
           x < std::min(width, x0 + most_radius); ++x) {
        const auto i = static_cast<std::size_t>(y * width + x);
        if (!scan.finite[i] || std::hypot(x - x0, y - y0) > radius) continue;
        scan.positions[i].setConstant(std::numeric_limits<float>::quiet_NaN());
        scan.finite[i] = 0;
        --scan.finite_count;
      }
    }
  }
}

// 1 within 11 pixels of another object.
std::vector<std::uint8_t> near_edges(const std::vector<std::uint32_t>& objects, std::int64_t width,
                                     std::int64_t height) {
  constexpr std::int64_t reach = 11;
  std::vector<std::uint8_t> near(objects.size(), 0);
  for (std::int64_t i = 0; i < width * height; ++i) {
    const std::int64_t x = i % width, y = i / width;
    for (std::int64_t v = std::max<std::int64_t>(0, y - reach); v <= std::min(height - 1, y + reach); ++v) {
      for (std::int64_t u = std::max<std::int64_t>(0, x - reach); u <= std::min(width - 1, x + reach); ++u) {
        if (objects[static_cast<std::size_t>(v * width + u)] != objects[static_cast<std::size_t>(i)])
          near[static_cast<std::size_t>(i)] = 1;
      }
    }
  }
  return near;
}

}  // namespace

SeenScene ground_and_boulders(const NoiseModel& noise) {
  Camera camera;
  camera.pose.stated = true;
  const CastRay cast = [](const Vector3d&, const Vector3d& ray) -> std::optional<Hit> {
    const Seen seen = look(ray);
    if (!std::isfinite(seen.s)) return std::nullopt;
    return Hit{seen.s, seen.object};
  };
  SeenScene scene{simulate_scan(camera, cast, noise, 1), {}, {}};
  lose_spots(scene.scan, 2);
  std::vector<std::uint32_t> objects;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const Seen seen = look(pixel_direction(camera, column, row));
      scene.normals.push_back(seen.normal.cast<float>());
      objects.push_back(seen.object);
    }
  }
  scene.near_edge = near_edges(objects, camera.width, camera.height);
  return scene;
}

}  // namespace patchlab::bench
