#include "engine/io/place_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/base/large_pages.h"
#include "engine/io/float_points.h"

namespace patchlab {
namespace {

constexpr double large = 1000.0;         // m: a float there is coarser than 0.05 mm
constexpr double wide_cloud = 500.0;     // m: more than most scans of metres span
constexpr double wide_view = 50.0;       // m: more than a depth camera sees, and a part made by CAD
constexpr double huge_coordinate = 1e7;  // m: no map projection reaches it

// The box of the points with finite coordinates, empty (low > high) where there are none.
struct Box {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
};

Box box_of(const Points& points) {
  Box box;
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite()) continue;
    box.low = box.low.min(point.array());
    box.high = box.high.max(point.array());
  }
  return box;
}

// Multiples of a power of two near the extent, and float: float coordinates minus the origin are exact. Only
// axes whose numbers get smaller by it are moved.
Eigen::Vector3d middle_origin(const Box& box, OriginRule rule) {
  const double smallest_coordinate = rule == OriginRule::always ? 0.0 : large;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (!(box.low <= box.high).all()) return origin;
  const double extent = (box.high - box.low).matrix().norm();
  const double step = extent > 0.0 ? std::exp2(std::floor(std::log2(extent))) : 1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double middle = 0.5 * (box.low(axis) + box.high(axis));
    if (std::abs(middle) < smallest_coordinate || std::abs(middle) <= extent) continue;
    const auto rounded = static_cast<float>(step * std::round(middle / step));
    if (std::isfinite(rounded)) origin(axis) = static_cast<double>(rounded);
  }
  return origin;
}

// Asked, never guessed: no file format carries its unit. Map coordinates are metres.
void ask_for_unit(Scan& scan, const Box& box) {
  const double span = (box.high - box.low).matrix().norm();
  constexpr std::string_view meshes[] = {"obj", "off", "stl"};
  const bool view = scan.organized() || std::ranges::find(meshes, scan.format) != std::end(meshes);
  if (span < (view ? wide_view : wide_cloud) || span > huge_coordinate || scan.origin.norm() > 10.0 * span)
    return;
  scan.notices.push_back(
      "The points span " + std::to_string(std::lround(span)) +
      " m, as patchlab takes coordinates for metres: are these millimetres? Then say --unit mm.");
}

// What follows from where the points lie.
void settle(Scan& scan, const Box& box, OriginRule rule) {
  scan.origin = middle_origin(box, rule);
  if ((box.low <= box.high).all()) ask_for_unit(scan, box);
}

void note_none(Scan& scan) {
  if (scan.finite_count == 0) scan.notices.emplace_back("None of the points has finite coordinates.");
}

}  // namespace

void place_points(Scan& scan, const Points& points, OriginRule rule) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr double limit = std::numeric_limits<float>::max();
  settle(scan, box_of(points), rule);
  scan.positions.resize(points.size());
  scan.finite.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d position = points[i] - scan.origin;
    const bool finite = (position.array().abs() <= limit).all();
    scan.positions[i] = finite ? Eigen::Vector3f(position.cast<float>()) : Eigen::Vector3f(nan, nan, nan);
    scan.finite[i] = finite ? 1 : 0;
    scan.finite_count += finite ? 1 : 0;
  }
  note_none(scan);
}

bool place_floats(Scan& scan, const std::array<const Column*, 3>& xyz, std::size_t points, OriginRule rule) {
  std::vector<Eigen::Vector3f> positions;
  reserve_large(positions, points);
  positions.resize(points);
  scan.finite.assign(points, 1);
  const FloatSurvey survey = take_floats(xyz, points, positions.data(), scan.finite.data());
  if (2 * survey.strange > survey.finite) return false;
  scan.positions = std::move(positions);
  scan.finite_count = survey.finite;
  note_none(scan);
  settle(
      scan,
      {Eigen::Array3f(survey.low.data()).cast<double>(), Eigen::Array3f(survey.high.data()).cast<double>()},
      rule);
  if (scan.origin.isZero(0.0)) return true;
  for (Eigen::Vector3f& p : scan.positions) p = (p.cast<double>() - scan.origin).cast<float>();
  return true;
}

}  // namespace patchlab
