#include "engine/io/scan_from_columns.h"

#include <cmath>
#include <limits>

#include "engine/io/covariance_columns.h"
#include "engine/io/plausible.h"
#include "engine/io/read_error.h"

namespace patchlab {
namespace {

using Names3 = std::array<std::string_view, 3>;
using Columns = std::span<const Column>;
using Points = std::vector<Eigen::Vector3d>;

constexpr std::uint64_t bytes_a_point = 128;  // of a Scan with everything, and of what it is made from
constexpr double large = 1000.0;              // m: a float there is coarser than 0.05 mm
constexpr double wide = 5000.0;               // m: more than a scan of metres spans

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

// Multiples of a power of two near the extent, and float: float coordinates minus the origin are exact. Only
// axes whose numbers get smaller by it are moved.
Eigen::Vector3d middle_origin(const Points& points, double smallest_coordinate) {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite()) continue;
    low = low.min(point.array());
    high = high.max(point.array());
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (!(low <= high).all()) return origin;
  const double extent = (high - low).matrix().norm();
  const double step = extent > 0.0 ? std::exp2(std::floor(std::log2(extent))) : 1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double middle = 0.5 * (low(axis) + high(axis));
    if (std::abs(middle) < smallest_coordinate || std::abs(middle) <= extent) continue;
    const auto rounded = static_cast<float>(step * std::round(middle / step));
    if (std::isfinite(rounded)) origin(axis) = static_cast<double>(rounded);
  }
  return origin;
}

void place_points(Scan& scan, const Points& points, OriginRule rule) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr double limit = std::numeric_limits<float>::max();
  scan.origin = middle_origin(points, rule == OriginRule::always ? 0.0 : large);
  scan.positions.resize(points.size());
  scan.finite.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d position = points[i] - scan.origin;
    const bool finite = (position.array().abs() <= limit).all();
    scan.positions[i] = finite ? Eigen::Vector3f(position.cast<float>()) : Eigen::Vector3f(nan, nan, nan);
    scan.finite[i] = finite ? 1 : 0;
    scan.finite_count += finite ? 1 : 0;
  }
  if (scan.finite_count == 0) scan.notices.emplace_back("None of the points has finite coordinates.");
  const std::optional<Bounds> box = bounds(scan);
  if (!box || (box->max - box->min).norm() < wide) return;
  scan.notices.emplace_back(
      "The points span kilometres: patchlab takes coordinates as metres; if these are millimetres, scale "
      "them first.");
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
  Points coordinates = gather3(xyz, points);
  if (const Result<void> plausible = check_plausible(scan, xyz, coordinates); !plausible) return plausible;

  const auto viewpoint_columns = find_columns(columns, viewpoint_names);
  Points viewpoints = is_complete(viewpoint_columns) ? gather3(viewpoint_columns, points) : Points{};
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
