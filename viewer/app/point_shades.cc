#include "viewer/app/point_shades.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scan/grid_normals.h"
#include "engine/scan/normals.h"

namespace patchlab::viewer {

namespace {

using Eigen::Vector3f;

// Neighbours on the grid whose distances differ by more than this share of the range are of another surface.
constexpr float edge = 0.08f;
// Where the light stands, seen from the sensor, in parts of the range: to the left and above.
constexpr float light_left = 0.45f, light_up = 0.55f;

// Central difference over the pixel grid; one-sided at edges; zero where no neighbour is of the same surface.
Vector3f difference(const Scan& scan, std::size_t i, std::size_t step, bool before, bool after, float range) {
  const auto usable = [&](std::size_t j) {
    return scan.finite[j] && (scan.positions[j] - scan.positions[i]).norm() < edge * range;
  };
  const Vector3f& here = scan.positions[i];
  const Vector3f& next = after && usable(i + step) ? scan.positions[i + step] : here;
  const Vector3f& last = before && usable(i - step) ? scan.positions[i - step] : here;
  return next - last;
}

// Means along one direction of the grid over `reach` pixels each side.
template <class Together>
std::vector<Vector3f> smoothed_along(const Scan& scan, const std::vector<Vector3f>& normals, int reach,
                                     bool rows, Together together) {
  const int width = static_cast<int>(scan.width), height = static_cast<int>(scan.height);
  std::vector<Vector3f> result(normals.size(), Vector3f::Zero());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      if (!scan.finite[i]) continue;
      for (int k = -reach; k <= reach; ++k) {
        const int nx = rows ? x + k : x, ny = rows ? y : y + k;
        if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
        const auto j = static_cast<std::size_t>(ny * width + nx);
        if (together(i, j)) result[i] += normals[j];
      }
      result[i].normalize();
    }
  }
  return result;
}

// First over all of one surface, so that a wild normal is outvoted; then over those that agree, so that edges
// stay.
std::vector<Vector3f> smoothed(const Scan& scan, const Vector3f& sensor, std::vector<Vector3f> normals,
                               int reach) {
  const auto of_one_surface = [&scan, &sensor](std::size_t i, std::size_t j) {
    const Vector3f& here = scan.positions[i];
    return scan.finite[j] && (scan.positions[j] - here).norm() < edge * (here - sensor).norm();
  };
  for (const bool rows : {true, false}) normals = smoothed_along(scan, normals, reach, rows, of_one_surface);
  for (const bool rows : {true, false}) {
    const std::vector<Vector3f>& now = normals;
    normals = smoothed_along(scan, now, reach, rows,
                             [&now](std::size_t i, std::size_t j) { return now[j].dot(now[i]) > 0.5f; });
  }
  return normals;
}

// The noise of a single point is as large as the steps between pixels: neighbours some pixels apart, then
// their mean.
std::vector<Vector3f> difference_normals(const Scan& scan, const Vector3f& sensor) {
  std::vector<Vector3f> normals(scan.size(), Vector3f::Zero());
  const std::size_t width = scan.width, reach = std::max<std::size_t>(2, width / 128);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    const std::size_t column = i % width, line = i / width;
    const float range = (scan.positions[i] - sensor).norm();
    const Vector3f along = difference(scan, i, reach, column >= reach, column + reach < width, range);
    const Vector3f down =
        difference(scan, i, reach * width, line >= reach, line + reach < scan.height, range);
    normals[i] = along.cross(down).normalized();
    if (normals[i].dot(sensor - scan.positions[i]) < 0) normals[i] = -normals[i];
  }
  return smoothed(scan, sensor, std::move(normals), static_cast<int>(reach));
}

// Range within the scan as 0 (near) to 1 (far), the outermost hundredths cut off.
struct Ranges {
  float near = 0, far = 1;
  float part(float range) const {
    return std::clamp((range - near) / std::max(far - near, 1e-6f), 0.0f, 1.0f);
  }
};

Ranges ranges_of(const Scan& scan, const Vector3f& sensor) {
  std::vector<float> ranges;
  ranges.reserve(scan.finite_count);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i]) ranges.push_back((scan.positions[i] - sensor).norm());
  }
  if (ranges.empty()) return {};
  const auto quantile = [&ranges](double q) {
    const auto at = ranges.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(ranges.size() - 1));
    std::nth_element(ranges.begin(), at, ranges.end());
    return *at;
  };
  return {quantile(0.01), quantile(0.99)};
}

std::vector<Vector3f> normals_of(const Scan& scan, const Vector3f& sensor, std::size_t limit) {
  if (std::vector<Vector3f> of_pixels = grid_normals(scan); !of_pixels.empty()) return of_pixels;
  if (scan.organized()) return difference_normals(scan, sensor);
  if (scan.finite_count <= limit) return estimate_normals(scan);
  return {};
}

}  // namespace

std::vector<std::uint8_t> point_shades(const Scan& scan, std::size_t normals_limit) {
  const Vector3f sensor = (scan.viewpoint.position - scan.origin).cast<float>();
  const Ranges ranges = ranges_of(scan, sensor);
  const std::vector<Vector3f> normals = normals_of(scan, sensor, normals_limit);
  const Eigen::Matrix3f axes = rotation(scan.viewpoint).cast<float>();  // x right, y down
  const Vector3f light = -light_left * axes.col(0) - light_up * axes.col(1);
  std::vector<std::uint8_t> shades(scan.size(), 0);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    const bool has_own = !scan.viewpoints.empty() && scan.viewpoints[i].allFinite();
    const Vector3f to_sensor = (has_own ? scan.viewpoints[i] : sensor) - scan.positions[i];
    const float range = (sensor - scan.positions[i]).norm();
    const float facing =
        normals.empty() ? 1.0f : normals[i].dot((to_sensor + to_sensor.norm() * light).normalized());
    const float lit = std::isfinite(facing) ? 0.15f + 0.85f * std::max(facing, 0.0f) : 0.15f;
    shades[i] = static_cast<std::uint8_t>(std::lround(255.0f * (1.0f - 0.45f * ranges.part(range)) * lit));
  }
  return shades;
}

}  // namespace patchlab::viewer
