#include "engine/scan/grid_normals.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "engine/scan/window_planes.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::SeededRandom;

const float no_number = std::numeric_limits<float>::quiet_NaN();
constexpr double f = 100.0;  // px

Vector3d ray(const Scan& scan, std::uint32_t x, std::uint32_t y) {
  return {(x - 0.5 * scan.width) / f, (y - 0.4 * scan.height) / f, 1.0};
}

// What a camera in some pose sees; depth_of tells the depth along a ray (s, t, 1), 0 where nothing is.
Scan seen(std::uint32_t width, std::uint32_t height, const std::function<double(const Vector3d&)>& depth_of) {
  Scan scan;
  scan.width = width;
  scan.height = height;
  scan.origin = {400.0, -20.0, 7.0};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()));
  scan.viewpoint = {{401.0, -20.5, 7.5}, {turn.x(), turn.y(), turn.z(), turn.w()}, true};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const double depth = depth_of(ray(scan, x, y));
      const Vector3d q = scan.viewpoint.position + turn * (depth * ray(scan, x, y)) - scan.origin;
      scan.positions.push_back(depth > 0.0 ? q.cast<float>().eval() : Vector3f::Constant(no_number).eval());
      scan.finite.push_back(depth > 0.0 ? 1 : 0);
      scan.finite_count += scan.finite.back();
    }
  }
  return scan;
}

// From the frame of the points.
Vector3d in_sensor(const Scan& scan, const Vector3f& normal) {
  return rotation(scan.viewpoint).transpose() * normal.cast<double>();
}

double plane_depth(const Vector3d& normal, double offset, const Vector3d& ray) {
  return offset / normal.dot(ray);
}

TEST(GridNormals, ArePerpendicularToAPlaneAndTurnedToTheSensor) {
  const Vector3d normal = Vector3d(0.4, -0.6, -1.0).normalized();
  const Scan scan = seen(173, 60, [&](const Vector3d& ray) { return plane_depth(normal, -1.2, ray); });
  const std::vector<Vector3f> normals = grid_normals(scan);
  ASSERT_EQ(normals.size(), scan.size());
  for (const Vector3f& n : normals) ASSERT_LT((in_sensor(scan, n) - normal).norm(), 2e-4);
}

TEST(GridNormals, FollowASphere) {
  const Vector3d centre(0.0, 0.1, 1.5);
  const Scan scan = seen(120, 90, [&](const Vector3d& ray) {
    const double a = ray.squaredNorm(), b = ray.dot(centre),
                 under = b * b - a * (centre.squaredNorm() - 0.25);
    return under > 0.0 ? (b - std::sqrt(under)) / a : 0.0;
  });
  const std::vector<Vector3f> normals = grid_normals(scan);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_EQ(normals[i].allFinite(), scan.finite[i] == 1) << i;
    if (!scan.finite[i]) continue;
    const Vector3d q = rotation(scan.viewpoint).transpose() * (scan.point(i) - scan.viewpoint.position);
    const Vector3d truth = (q - centre).normalized();
    if (-truth.dot(q.normalized()) < 0.6) continue;
    EXPECT_GT(in_sensor(scan, normals[i]).dot(truth), std::cos(0.03)) << i;  // they turn by 0.2 in a window
  }
}

TEST(GridNormals, DoNotMixSurfacesAtAJumpNorAcrossMissingPixels) {
  const Vector3d near = Vector3d(0.5, 0.0, -1.0).normalized(), far = Vector3d(-0.5, 0.0, -1.0).normalized();
  for (const double gap : {0.0, 0.05}) {
    const Scan scan = seen(100, 40, [&](const Vector3d& ray) {
      if (std::abs(ray.x()) < gap) return 0.0;
      return ray.x() < 0.0 ? plane_depth(near, -1.0, ray) : plane_depth(far, -1.3, ray);
    });
    const std::vector<Vector3f> normals = grid_normals(scan);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (!scan.finite[i]) continue;
      const Vector3d& truth = i % 100 < 50 ? near : far;
      ASSERT_LT((in_sensor(scan, normals[i]) - truth).norm(), 1e-3) << gap << " " << i;
    }
  }
}

TEST(GridNormals, AreMissingWhereThePointIsOrItsWindowIsOneLine) {
  const Scan column = seen(60, 30, [](const Vector3d& ray) { return std::abs(ray.x()) < 0.002 ? 1.0 : 0.0; });
  ASSERT_EQ(column.finite_count, 30u);
  for (const Vector3f& n : grid_normals(column)) EXPECT_TRUE(std::isnan(n.x()));
}

TEST(GridNormals, NeedThePixelsOfACamera) {
  const Scan plane = seen(80, 60, [](const Vector3d&) { return 1.0; });
  const std::optional<std::array<double, 4>> pinhole = pinhole_of(plane);
  ASSERT_TRUE(pinhole);
  EXPECT_NEAR((*pinhole)[0], f, 1e-2);
  EXPECT_NEAR((*pinhole)[1], f, 1e-2);
  EXPECT_NEAR((*pinhole)[2], 40.0, 1e-2);
  EXPECT_NEAR((*pinhole)[3], 24.0, 1e-2);

  Scan row = plane;
  row.width = 4800;
  row.height = 1;
  Scan own_viewpoints = plane;
  own_viewpoints.viewpoints.resize(plane.size());
  Scan behind = plane;
  behind.viewpoint.position += 3.0 * rotation(plane.viewpoint).col(2);
  Scan around = plane;  // a scanner that turns
  for (std::uint32_t i = 0; i < around.size(); ++i) {
    const double turn = i % 80 / 40.0 - 1.0, tilt = i / 80 / 60.0;
    const Vector3d q(std::sin(turn), std::tan(tilt), std::cos(turn));
    around.positions[i] =
        (around.viewpoint.position + rotation(around.viewpoint) * q - around.origin).cast<float>();
  }
  Scan empty = plane;
  empty.finite.assign(empty.size(), 0);
  for (const Scan& scan : {row, own_viewpoints, behind, around, empty}) {
    EXPECT_FALSE(pinhole_of(scan));
    EXPECT_TRUE(grid_normals(scan).empty());
  }
}

TEST(GridNormals, AreTheSameOnAnyNumberOfThreads) {
  SeededRandom random;
  const Scan scan = seen(321, 200, [&](const Vector3d& ray) {
    return random.uniform() < 0.05 ? 0.0 : (ray.x() > 0.3 ? 1.5 : 1.0) + 0.01 * random.normal();
  });
  const std::vector<Vector3f> many = grid_normals(scan);
  std::vector<Vector3f> one;
  tbb::task_arena(1).execute([&] { one = grid_normals(scan); });
  EXPECT_EQ(std::memcmp(many.data(), one.data(), many.size() * sizeof(Vector3f)), 0);
}

// Random depths: two surfaces with noise, and holes.
std::vector<float> random_grid(Random& random, const GridPoints& grid) {
  std::vector<float> xyz;
  const double border = random.uniform(0.0, static_cast<double>(grid.width));
  for (std::ptrdiff_t y = 0; y < grid.height; ++y) {
    for (std::ptrdiff_t x = 0; x < grid.width; ++x) {
      const double depth = (static_cast<double>(x) < border ? 1.0 : 1.4) + 0.02 * random.normal();
      xyz.insert(xyz.end(), {0.0F, 0.0F, random.uniform() < 0.1 ? no_number : static_cast<float>(depth)});
    }
  }
  return xyz;
}

std::int64_t fixed_point(const GridPoints& grid, std::ptrdiff_t x, std::ptrdiff_t y) {
  if (x < 0 || y < 0 || x >= grid.width || y >= grid.height) return 0;
  const float depth = grid.xyz[3 * (y * grid.width + x) + 2];
  return std::isfinite(depth) ? static_cast<std::int64_t>(grid.scale / depth) : 0;
}

// Pixel by pixel, in the words of window_planes.h.
Vector3d normal_of_window(const GridPoints& grid, const WindowCamera& camera, std::ptrdiff_t x,
                          std::ptrdiff_t y) {
  const std::int64_t here = fixed_point(grid, x, y), same = std::max<std::int64_t>(here / 16, grid.noise);
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (std::ptrdiff_t j = -window_reach; j <= window_reach; ++j) {
    for (std::ptrdiff_t k = -window_reach; k <= window_reach; ++k) {
      const std::int64_t d = fixed_point(grid, x + k, y + j);
      if (d == 0 || std::abs(d - here) > same) continue;
      const Vector3d row(
          (static_cast<double>(x + k) - static_cast<double>(camera.cx)) / static_cast<double>(camera.fx),
          (static_cast<double>(y + j) - static_cast<double>(camera.cy)) / static_cast<double>(camera.fy),
          1.0);
      A += row * row.transpose();
      b += static_cast<double>(d) * row;
    }
  }
  return -A.ldlt().solve(b).normalized();
}

TEST(GridNormals, OfEveryKernelAreTheLeastSquaresOfTheirWindows) {
  SeededRandom random;
  WindowCamera camera{120.0F, 110.0F, 90.0F, 20.0F, {}};
  for (int i = 0; i < 3; ++i) camera.minus_points_from_sensor[4 * i] = -1.0F;
  for (const std::ptrdiff_t width : {1, 7, 170, 331}) {
    GridPoints grid{nullptr, width, 23, {0, 0, 1}, 0, 131072, 9000};
    const std::vector<float> xyz = random_grid(random, grid);
    grid.xyz = xyz.data();
    std::vector<float> plain(xyz.size()), fast(xyz.size());
    plain_windows().normals_of_rows(grid, camera, 0, 23, plain.data());
    const WindowKernel* const avx2 = avx2_windows();
    (avx2 != nullptr ? *avx2 : plain_windows()).normals_of_rows(grid, camera, 0, 11, fast.data());
    fastest_windows().normals_of_rows(grid, camera, 11, 23, fast.data());
    EXPECT_EQ(std::memcmp(plain.data(), fast.data(), plain.size() * sizeof(float)), 0) << width;
    for (std::ptrdiff_t i = 0; i < width * 23 && width > 1; ++i) {
      const Vector3d normal = Eigen::Map<const Vector3f>(plain.data() + 3 * i).cast<double>();
      ASSERT_EQ(normal.allFinite(), std::isfinite(xyz[static_cast<std::size_t>(3 * i + 2)]))
          << width << " " << i;
      if (!normal.allFinite()) continue;
      ASSERT_LT((normal - normal_of_window(grid, camera, i % width, i / width)).norm(), 2e-4)
          << width << " " << i;
    }
  }
}

}  // namespace
}  // namespace patchlab
