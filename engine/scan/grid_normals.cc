#include "engine/scan/grid_normals.h"

#include <algorithm>
#include <cmath>

#include "engine/base/large_pages.h"
#include "engine/base/parallel.h"
#include "engine/scan/window_planes.h"

namespace patchlab {
namespace {

constexpr std::size_t rows_a_chunk = 60;
constexpr std::size_t most_samples = 1024;
constexpr double most_off_pixel = 1.0;     // px, root mean square: noise moves points off their pixels' rays
constexpr float median_inverse = 1 << 17;  // of the median point, in fixed point
constexpr double surface_sigmas = 6.0;     // between pixels of one surface

float depth_of(const GridPoints& points, const Eigen::Vector3f& p) {
  return points.axis[0] * p.x() + points.axis[1] * p.y() + points.axis[2] * p.z() + points.offset;
}

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::size_t sample_step(const Scan& scan) { return 1 | (scan.size() / most_samples); }

// Sums for v = slope * pixel + first.
struct Line {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  void add(double pixel, double v) {
    n += 1;
    x += pixel;
    y += v;
    xx += pixel * pixel;
    xy += pixel * v;
    yy += v * v;
  }
  double slope() const { return (n * xy - x * y) / (n * xx - x * x); }
  double first() const { return (y - slope() * x) / n; }
  double mean_square() const {
    const double cov = xy - x * y / n;
    return std::max(0.0, (yy - y * y / n - slope() * cov) / n);
  }
  bool straight() const { return slope() > 0.0 && std::sqrt(mean_square()) < most_off_pixel * slope(); }
};

// The median inverse depth, 1/m, and the standard deviation of its noise, by second differences along rows:
// three pixels of a surface.
struct Sampled {
  double median, sigma;
};
Sampled sample_inverse(const Scan& scan, const GridPoints& points) {
  std::vector<double> values, seconds;
  const auto inverse = [&](std::size_t i) {
    return scan.finite[i] ? 1.0 / static_cast<double>(depth_of(points, scan.positions[i])) : -1.0;
  };
  for (std::size_t i = 1; i + 1 < scan.size(); i += sample_step(scan)) {
    const double before = inverse(i - 1), here = inverse(i), after = inverse(i + 1);
    if (here > 0.0) values.push_back(here);
    if (std::min({before, here, after}) > 0.0) seconds.push_back(std::abs(before - 2.0 * here + after));
  }
  constexpr double sigma_a_median =
      1.4826 / 2.4495;  // of normal numbers; their second difference has 6 variances
  return {median(values), sigma_a_median * median(seconds)};
}

GridPoints grid_points(const Scan& scan) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  const Eigen::Vector3d axis = rotation(scan.viewpoint).col(2);
  GridPoints points = {};
  points.xyz = scan.positions.front().data();
  points.width = static_cast<std::ptrdiff_t>(scan.width);
  points.height = static_cast<std::ptrdiff_t>(scan.height);
  Eigen::Map<Eigen::Vector3f>(points.axis) = axis.cast<float>();
  points.offset = static_cast<float>(axis.dot(scan.origin - scan.viewpoint.position));
  const Sampled sampled = sample_inverse(scan, points);
  if (!(sampled.median > 0.0)) return points;  // nothing is before the camera: of scale 0 nothing is usable
  points.scale = median_inverse / static_cast<float>(sampled.median);
  points.noise = static_cast<std::int32_t>(
      std::min(surface_sigmas * sampled.sigma * static_cast<double>(points.scale), most_inverse / 2.0));
  return points;
}

WindowCamera window_camera(const Scan& scan, const std::array<double, 4>& pinhole) {
  WindowCamera camera{static_cast<float>(pinhole[0]),
                      static_cast<float>(pinhole[1]),
                      static_cast<float>(pinhole[2]),
                      static_cast<float>(pinhole[3]),
                      {}};
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(camera.minus_points_from_sensor) =
      -rotation(scan.viewpoint).cast<float>();
  return camera;
}

}  // namespace

std::optional<std::array<double, 4>> pinhole_of(const Scan& scan) {
  if (!scan.organized() || !scan.viewpoints.empty()) return std::nullopt;
  if (scan.intrinsics) return scan.intrinsics;
  const Eigen::Matrix3d sensor_from_points = rotation(scan.viewpoint).transpose();
  Line along, down;
  for (std::size_t i = 0; i < scan.size(); i += sample_step(scan)) {
    if (!scan.finite[i]) continue;
    const Eigen::Vector3d q = sensor_from_points * (scan.point(i) - scan.viewpoint.position);
    if (!(q.z() > 0.0)) return std::nullopt;
    along.add(static_cast<double>(i % scan.width), q.x() / q.z());
    down.add(static_cast<double>(i / scan.width), q.y() / q.z());
  }
  if (!along.straight() || !down.straight()) return std::nullopt;
  return std::array{1.0 / along.slope(), 1.0 / down.slope(), -along.first() / along.slope(),
                    -down.first() / down.slope()};
}

std::vector<Eigen::Vector3f> grid_normals(const Scan& scan) {
  const std::optional<std::array<double, 4>> pinhole = pinhole_of(scan);
  if (!pinhole) return {};
  const GridPoints points = grid_points(scan);
  const WindowCamera camera = window_camera(scan, *pinhole);
  std::vector<Eigen::Vector3f> normals;
  reserve_large(normals, scan.size());
  normals.resize(scan.size());
  for_each_chunk(scan.height, rows_a_chunk, [&](const Chunk& rows) {
    fastest_windows().normals_of_rows(points, camera, static_cast<std::ptrdiff_t>(rows.first),
                                      static_cast<std::ptrdiff_t>(rows.last), normals.front().data());
  });
  return normals;
}

}  // namespace patchlab
