#include "engine/io/scan_from_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/io/covariance_columns.h"
#include "engine/io/place_points.h"
#include "engine/io/plausible.h"
#include "engine/io/read_error.h"

namespace patchlab {
namespace {

using Names3 = std::array<std::string_view, 3>;
using Columns = std::span<const Column>;

constexpr std::uint64_t bytes_a_point = 128;  // of a Scan with everything, and of what it is made from

constexpr Names3 coordinate_names = {"x", "y", "z"};
constexpr Names3 viewpoint_names = {"vp_x", "vp_y", "vp_z"};
constexpr Names3 colour_names[] = {{"red", "green", "blue"}, {"r", "g", "b"}};
constexpr std::array<std::string_view, 2> packed_colour_names = {"rgb", "rgba"};
constexpr std::array<std::string_view, 1> label_name = {"label"};

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

// Nothing of these files needs the coordinates as doubles: no other type or byte order, unit, frame,
// covariance or position of a sensor.
bool are_plain_floats(const Scan& scan, Columns columns, const std::array<const Column*, 3>& xyz,
                      const ReadOptions& options) {
  const bool as_they_stand =
      options.unit == LengthUnit::m && !(options.points_in_sensor_frame && scan.viewpoint.stated);
  return as_they_stand && std::ranges::all_of(xyz, [](const Column* c) { return is_plain_float(*c); }) &&
         std::ranges::none_of(columns, [](const Column& column) {
           return is_covariance_column(column.name) ||
                  std::ranges::find(viewpoint_names, column.name) != viewpoint_names.end();
         });
}

void fill_colours(Scan& scan, Columns columns, std::size_t points) {
  for (const Column* packed : find_columns(columns, packed_colour_names)) {
    if (packed == nullptr || size_of(packed->type) != 4) continue;
    Column bits = *packed;
    bits.type = Scalar::uint32;
    for (const double value : values(bits, points)) {
      const auto rgb = static_cast<std::uint32_t>(value);
      scan.colours.push_back({static_cast<std::uint8_t>(rgb >> 16 & 255),
                              static_cast<std::uint8_t>(rgb >> 8 & 255),
                              static_cast<std::uint8_t>(rgb & 255)});
    }
    return;
  }
  for (const Names3& names : colour_names) {
    const auto found = find_columns(columns, names);
    if (!is_complete(found) ||
        std::ranges::any_of(found, [](const Column* c) { return c->type != Scalar::uint8; }))
      continue;
    for (const Eigen::Vector3d& colour : gather3(found, points)) {
      const Eigen::Matrix<std::uint8_t, 3, 1> bytes = colour.cast<std::uint8_t>();
      scan.colours.push_back({bytes(0), bytes(1), bytes(2)});
    }
    return;
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
  return has(coordinate_names) || has(viewpoint_names) || has(label_name) || is_covariance_column(name);
}

Result<void> fill_scan(Scan& scan, std::span<const Column> columns, std::size_t points, OriginRule rule,
                       const ReadOptions& options) {
  const auto xyz = find_columns(columns, coordinate_names);
  if (!is_complete(xyz)) {
    const auto missing = static_cast<std::size_t>(std::ranges::find(xyz, nullptr) - xyz.begin());
    return unreadable(scan.file, "has no field '" + std::string(coordinate_names[missing]) +
                                     "' with one value a point; a scan needs x, y and z.");
  }
  if (are_plain_floats(scan, columns, xyz, options) && place_floats(scan, xyz, points, rule)) {
    fill_colours(scan, columns, points);
    fill_labels(scan, columns, points);
    use_intrinsics(scan, options);
    return {};
  }
  Points coordinates = gather3(xyz, points);
  if (const Result<void> plausible = check_plausible(scan, xyz, coordinates); !plausible) return plausible;

  const auto viewpoint_columns = find_columns(columns, viewpoint_names);
  Points viewpoints = is_complete(viewpoint_columns) ? gather3(viewpoint_columns, points) : Points{};
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
  fill_colours(scan, columns, points);
  fill_labels(scan, columns, points);
  for (const Eigen::Vector3d& viewpoint : viewpoints) {
    scan.viewpoints.push_back((viewpoint - scan.origin).cast<float>());
  }

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

Result<void> check_memory(const std::string& name, std::uint64_t points, std::uint64_t more,
                          const ReadOptions& options) {
  const std::uint64_t needed = points * bytes_a_point + more;
  if (needed <= options.memory_limit) return {};
  return unreadable(name, "its " + std::to_string(points) + " points would take " +
                              std::to_string(needed >> 20) + " MB of memory, more than the limit of " +
                              std::to_string(options.memory_limit >> 20) + " MB.");
}

}  // namespace patchlab
