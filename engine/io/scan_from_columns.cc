#include "engine/io/scan_from_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/base/large_pages.h"
#include "engine/io/covariance_columns.h"
#include "engine/io/place_points.h"
#include "engine/io/plausible.h"
#include "engine/io/read_error.h"

namespace patchlab {
namespace {

using Names3 = std::array<std::string_view, 3>;
using Columns = std::span<const Column>;

// Of a point in memory: its position, then what of it is kept besides and while it is read.
constexpr std::uint64_t position_bytes = 13, double_bytes = 24, colour_bytes = 3, label_bytes = 12,
                        intensity_bytes = 12, viewpoint_bytes = 36, covariance_bytes = 72;

constexpr Names3 coordinate_names = {"x", "y", "z"};
constexpr Names3 viewpoint_names = {"vp_x", "vp_y", "vp_z"};
constexpr Names3 colour_names[] = {{"red", "green", "blue"}, {"r", "g", "b"}};
constexpr std::array<std::string_view, 2> packed_colour_names = {"rgb", "rgba"};
constexpr std::array<std::string_view, 1> label_name = {"label"};
constexpr std::array<std::string_view, 5> intensity_names = {"intensity", "reflectivity", "reflectance",
                                                             "scalar_intensity", "scalar_Intensity"};

Points gather3(const std::array<const Column*, 3>& xyz, std::size_t points) {
  Points out(points);
  for (std::size_t axis = 0; axis < 3; ++axis) gather(*xyz[axis], points, 0, out[0].data() + axis, 3);
  return out;
}

void transform(Points& points, const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  for (Eigen::Vector3d& point : points) point = R * point + t;
}

void scale(Points& points, double factor) {
  if (factor == 1.0) return;
  for (Eigen::Vector3d& point : points) point *= factor;
}
void scale(std::vector<Covariance6>& covariances, double factor) {
  if (factor == 1.0) return;
  for (Covariance6& covariance : covariances) {
    for (double& entry : covariance) entry *= factor;
  }
}

Result<void> check_plausible(Scan& scan, const std::array<const Column*, 3>& xyz, const Points& points) {
  const Plausibility plausibility = judge_coordinates({*xyz[0], *xyz[1], *xyz[2]}, points);
  if (plausibility == Plausibility::plausible) return {};
  if (scan.encoding != "ascii" && plausibility == Plausibility::other_order) {
    return unreadable(scan.file,
                      "its coordinates make sense in the other byte order only; write the file again, as "
                      "ascii for example.");
  }
  if (scan.encoding != "ascii" && plausibility == Plausibility::other_type) {
    return unreadable(scan.file, "its coordinates are not the " + std::string(name(xyz[0]->type)) +
                                     " numbers the header promises; correct the types in the header.");
  }
  scan.notices.emplace_back(
      "More than half of the points have coordinates beyond 1e7 or below 1e-30: the file may be damaged.");
  return {};
}

bool is_plain_float(const Column& column) { return column.type == Scalar::float32 && !column.swapped; }

// Nothing of these columns needs the coordinates as doubles: no other type or byte order, covariance or
// position of a sensor.
bool are_plain_floats(Columns columns) {
  const auto xyz = find_columns(columns, coordinate_names);
  return is_complete(xyz) && std::ranges::all_of(xyz, [](const Column* c) { return is_plain_float(*c); }) &&
         std::ranges::none_of(columns, [](const Column& column) {
           return is_covariance_column(column.name) ||
                  std::ranges::find(viewpoint_names, column.name) != viewpoint_names.end();
         });
}

// In their unit and frame.
bool as_they_stand(const Scan& scan, const ReadOptions& options) {
  return options.unit == LengthUnit::m && !(options.points_in_sensor_frame && scan.viewpoint.stated);
}

// Their positions are known, so nothing is assumed of where the sensor stood.
void use_viewpoints(Scan& scan, const Points& viewpoints) {
  if (viewpoints.empty()) return;
  std::erase_if(scan.notices, [](const std::string& notice) { return notice.ends_with(at_the_origin); });
  std::size_t unknown = 0;
  for (const Eigen::Vector3d& viewpoint : viewpoints) {
    scan.viewpoints.push_back((viewpoint - scan.origin).cast<float>());
    unknown += scan.viewpoints.back().allFinite() ? 0 : 1;
  }
  if (unknown > 0)
    scan.notices.push_back(
        "Points whose sensor position is not finite are taken as seen from the viewpoint of the scan: " +
        std::to_string(unknown) + " of them.");
}

Result<Points> viewpoints_of(const Scan& scan, Columns columns, std::size_t points) {
  const auto found = find_columns(columns, viewpoint_names);
  if (is_complete(found)) return gather3(found, points);
  if (std::ranges::count(found, nullptr) == 3) return Points{};
  const auto missing = static_cast<std::size_t>(std::ranges::find(found, nullptr) - found.begin());
  return unreadable(scan.file, "the position of a point's sensor takes three fields; '" +
                                   std::string(viewpoint_names[missing]) + "' is missing.");
}

// Blue, green, red from the lowest of four bytes, or the other way round from the highest.
template <bool swapped>
std::array<std::uint8_t, 3> unpacked(const char* bytes) {
  std::array<std::uint8_t, 4> b;
  std::memcpy(b.data(), bytes, b.size());
  return swapped ? std::array{b[1], b[2], b[3]} : std::array{b[2], b[1], b[0]};
}

// A block at a time, which stays in the cache until it is appended.
template <class ColourAt>
void append_colours(Scan& scan, std::size_t points, const ColourAt& colour_at) {
  constexpr std::size_t block = 1024;
  reserve_large(scan.colours, points);
  std::array<std::array<std::uint8_t, 3>, block> some;
  for (std::size_t first = 0; first < points; first += block) {
    const std::size_t count = std::min(block, points - first);
    for (std::size_t i = 0; i < count; ++i) some[i] = colour_at(first + i);
    scan.colours.insert(scan.colours.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
  }
}

void fill_colours(Scan& scan, Columns columns, std::size_t points) {
  for (const Column* packed : find_columns(columns, packed_colour_names)) {
    if (packed == nullptr || size_of(packed->type) != 4) continue;
    const char* const first = packed->first;
    const std::size_t stride = packed->stride;
    return packed->swapped ? append_colours(scan, points,
                                            [&](std::size_t i) { return unpacked<true>(first + i * stride); })
                           : append_colours(scan, points, [&](std::size_t i) {
                               return unpacked<false>(first + i * stride);
                             });
  }
  for (const Names3& names : colour_names) {
    const auto found = find_columns(columns, names);
    if (!is_complete(found) ||
        std::ranges::any_of(found, [](const Column* c) { return c->type != Scalar::uint8; }))
      continue;
    const auto byte = [](const Column& column, std::size_t i) {
      return static_cast<std::uint8_t>(column.first[i * column.stride]);
    };
    return append_colours(scan, points, [&](std::size_t i) {
      return std::array{byte(*found[0], i), byte(*found[1], i), byte(*found[2], i)};
    });
  }
}

void fill_labels(Scan& scan, Columns columns, std::size_t points) {
  const auto [column] = find_columns(columns, label_name);
  if (column == nullptr) return;
  std::size_t dropped = 0;
  for (const double value : values(*column, points)) {
    const bool label =
        value >= 0.0 && value <= std::numeric_limits<std::uint32_t>::max() && value == std::floor(value);
    scan.labels.push_back(label ? static_cast<std::uint32_t>(value) : 0);
    dropped += label ? 0 : 1;
  }
  if (dropped == 0) return;
  scan.notices.push_back("Labels that are not whole numbers from 0 up were taken as 0, no label: " +
                         std::to_string(dropped) + " of them.");
}

void fill_intensities(Scan& scan, Columns columns, std::size_t points) {
  for (const Column* const column : find_columns(columns, intensity_names)) {
    if (column == nullptr) continue;
    const std::vector<double> found = values(*column, points);
    scan.intensities.assign(found.begin(), found.end());
    return;
  }
}

void fill_what_is_beside(Scan& scan, Columns columns, std::size_t points) {
  fill_colours(scan, columns, points);
  fill_labels(scan, columns, points);
  fill_intensities(scan, columns, points);
}

bool has_any(Columns columns, std::span<const std::string_view> names) {
  return std::ranges::any_of(names,
                             [&](std::string_view name) { return find_column(columns, name) != nullptr; });
}

// At most.
std::uint64_t bytes_a_point(Columns columns, bool plain_floats) {
  std::uint64_t bytes = position_bytes + (plain_floats ? 0 : double_bytes);
  const bool coloured = has_any(columns, packed_colour_names) || has_any(columns, colour_names[0]) ||
                        has_any(columns, colour_names[1]);
  if (coloured) bytes += colour_bytes;
  if (has_any(columns, label_name)) bytes += label_bytes;
  if (has_any(columns, intensity_names)) bytes += intensity_bytes;
  if (has_any(columns, viewpoint_names)) bytes += viewpoint_bytes;
  if (std::ranges::any_of(columns, [](const Column& column) { return is_covariance_column(column.name); }))
    bytes += covariance_bytes;
  return bytes;
}

void use_intrinsics(Scan& scan, const ReadOptions& options) {
  if (options.intrinsics && scan.organized()) {
    const Intrinsics& camera = *options.intrinsics;
    scan.intrinsics = {camera.fx, camera.fy, camera.cx, camera.cy};
  } else if (options.intrinsics || options.depth_scale > 0.0) {
    scan.notices.emplace_back("Intrinsics and depth scale are those of depth images; this is none.");
  }
}

void note_covariances(Scan& scan) {
  const CovarianceCount count = judge_covariances(scan.covariances, scan.finite);
  if (count.clamped > 0)
    scan.notices.push_back("Covariances that are negative by rounding were made positive semi-definite: " +
                           std::to_string(count.clamped) + " of them.");
  if (count.bad > 0)
    scan.notices.push_back("Covariances that are not positive semi-definite, or not finite: " +
                           std::to_string(count.bad) + "; a fit that uses one of them is refused.");
}

}  // namespace

bool is_point_table_column(std::string_view name) {
  const auto has = [&](const auto& names) { return std::ranges::find(names, name) != names.end(); };
  return has(coordinate_names) || has(viewpoint_names) || has(label_name) || has(intensity_names) ||
         is_covariance_column(name);
}

Result<void> fill_scan(Scan& scan, std::span<const Column> columns, std::size_t points, OriginRule rule,
                       const ReadOptions& options) {
  const auto xyz = find_columns(columns, coordinate_names);
  if (!is_complete(xyz)) {
    const auto missing = static_cast<std::size_t>(std::ranges::find(xyz, nullptr) - xyz.begin());
    return unreadable(scan.file, "has no field '" + std::string(coordinate_names[missing]) +
                                     "' with one value a point; a scan needs x, y and z.");
  }
  if (options.points_in_sensor_frame && !scan.viewpoint.stated)
    scan.notices.emplace_back(
        "The file states no viewpoint that would move its points out of the frame of the sensor.");
  const bool plain = are_plain_floats(columns) && as_they_stand(scan, options);
  const std::uint64_t more = bytes_a_point(columns, plain) - position_bytes;
  if (const auto fits = check_memory(scan.file, points, points * more, options); !fits) return fits;
  const Error cancelled{ErrorCode::cancelled, scan.file + ": reading was cancelled."};
  if (!keep_going(options.progress, 1.0)) return cancelled;
  if (plain && place_floats(scan, xyz, points, rule)) {
    fill_what_is_beside(scan, columns, points);
    use_intrinsics(scan, options);
    return {};
  }
  Points coordinates = gather3(xyz, points);
  if (const Result<void> plausible = check_plausible(scan, xyz, coordinates); !plausible) return plausible;

  Result<Points> found_viewpoints = viewpoints_of(scan, columns, points);
  if (!found_viewpoints) return found_viewpoints.error();
  Points& viewpoints = *found_viewpoints;
  const double unit = metres(options.unit);
  for (Points* const lengths : {&coordinates, &viewpoints}) scale(*lengths, unit);
  scan.viewpoint.position *= unit;
  CovarianceFrame frame;
  if (options.points_in_sensor_frame && scan.viewpoint.stated) {
    frame.points_from_file = rotation(scan.viewpoint);
    transform(coordinates, frame.points_from_file, scan.viewpoint.position);
    transform(viewpoints, frame.points_from_file, scan.viewpoint.position);
  }
  place_points(scan, coordinates, rule);
  fill_what_is_beside(scan, columns, points);
  use_viewpoints(scan, viewpoints);
  if (!keep_going(options.progress, 1.0)) return cancelled;

  Points& rays = coordinates;
  for (std::size_t i = 0; i < points; ++i)
    rays[i] -= viewpoints.empty() ? scan.viewpoint.position : viewpoints[i];
  frame.rays = rays;
  Result<std::vector<Covariance6>> covariances = read_covariances(columns, frame, scan.file);
  if (!covariances) return covariances.error();
  scan.covariances = std::move(*covariances);
  scale(scan.covariances, unit * unit);
  note_covariances(scan);
  use_intrinsics(scan, options);
  return {};
}

std::uint64_t memory_of_point(std::span<const Column> columns) {
  return bytes_a_point(columns, are_plain_floats(columns));
}

Result<void> check_memory(const std::string& name, std::uint64_t points, std::uint64_t more,
                          const ReadOptions& options) {
  const std::uint64_t needed = points * position_bytes + more;
  if (needed <= options.memory_limit) return {};
  return unreadable(name, "its " + std::to_string(points) + " points would take " +
                              std::to_string(needed >> 20) + " MB of memory, more than the limit of " +
                              std::to_string(options.memory_limit >> 20) +
                              " MB; thin it out, or cut it into parts.");
}

}  // namespace patchlab
