#include "engine/io/kitti.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/io/read_error.h"
#include "engine/io/read_scan.h"
#include "engine/io/scan_from_columns.h"

namespace patchlab {
namespace {

constexpr std::size_t kitti_values = 4, nuscenes_values = 5;
constexpr float farthest = 1000.F;  // m: no lidar on a car sees so far

float value(std::string_view bytes, std::size_t index) {
  float number;
  std::memcpy(&number, bytes.data() + index * sizeof number, sizeof number);
  return number;
}

// Records of `values` float32 each: coordinates within reach, an intensity, and where there are five the
// number of a laser. Without a header that is all there is to recognise.
bool looks_like(std::string_view bytes, std::size_t values) {
  if (bytes.empty() || bytes.size() % (values * sizeof(float)) != 0) return false;
  std::size_t spread = 0;
  for (std::size_t i = 0; i < bytes.size() / sizeof(float); i += values) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float size = std::abs(value(bytes, i + k));
      if (!(size < farthest) || (size > 0.F && size < 1e-30F)) return false;
      spread += size > 1e-3F ? 1 : 0;
    }
    const float intensity = value(bytes, i + 3);
    if (!(intensity >= 0.F && intensity <= 255.F)) return false;
    if (values < nuscenes_values) continue;
    const float laser = value(bytes, i + 4);
    if (!(laser >= 0.F && laser < 256.F) || laser != std::floor(laser)) return false;
  }
  return spread > 0;
}

std::size_t values_a_point(std::string_view bytes) {
  for (const std::size_t values : {nuscenes_values, kitti_values}) {
    if (looks_like(bytes, values)) return values;
  }
  return 0;
}

}  // namespace

bool is_kitti(std::string_view bytes) { return values_a_point(bytes) > 0; }

Result<Scan> read_kitti(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const std::size_t values = values_a_point(bytes);
  if (values == 0) {
    return unreadable(name,
                      "is no KITTI scan: not all of it are records of x, y, z and intensity as four float32, "
                      "within 1 km of the sensor.");
  }
  const std::size_t step = values * sizeof(float), points = bytes.size() / step;
  if (const auto fits = check_memory(name, points, 0, options); !fits) return fits.error();
  Scan scan;
  scan.file = name;
  scan.format = "kitti";
  scan.encoding = "binary";
  scan.width = static_cast<std::uint32_t>(points);
  constexpr const char* names[] = {"x", "y", "z", "intensity", "ring"};
  std::vector<Column> columns;
  for (std::size_t k = 0; k < values; ++k) {
    scan.fields.push_back({names[k], "float32", 1});
    columns.push_back({names[k], Scalar::float32, 1, bytes.data() + k * sizeof(float), step});
  }
  // The sensor is the origin of its points; it looks along +x, with z up.
  scan.viewpoint = {Eigen::Vector3d::Zero(), {-0.5, 0.5, -0.5, 0.5}, true};
  scan.notices.push_back("A file without a header: " + std::to_string(values) +
                         " numbers a point are taken as x, y, z, intensity" +
                         (values == nuscenes_values ? " and laser, as nuScenes" : ", as KITTI") +
                         " writes them.");
  const auto filled = fill_scan(scan, columns, points, OriginRule::where_large, options);
  if (!filled) return filled.error();
  return scan;
}

}  // namespace patchlab
