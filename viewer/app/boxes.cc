#include "viewer/app/boxes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/mesh/patch_mesh.h"
#include "viewer/app/map_scene.h"

namespace patchlab::viewer {

namespace {

constexpr double share_before_sensor = 0.95;

class Box {
 public:
  void add(const Eigen::Vector3d& point) {
    if (!box_) box_ = Bounds{point, point};
    box_->min = box_->min.cwiseMin(point);
    box_->max = box_->max.cwiseMax(point);
  }
  void add(const std::optional<Bounds>& other) {
    if (!other) return;
    add(other->min);
    add(other->max);
  }
  const std::optional<Bounds>& result() const { return box_; }

 private:
  std::optional<Bounds> box_;
};

}  // namespace

std::optional<Bounds> box_of(const Document& document) {
  Box box;
  for (const ScanEntry& entry : document.scans) {
    if (entry.visible && entry.scan) box.add(bounds(*entry.scan));
  }
  for (const PatchEntry& entry : document.patches) {
    if (entry.visible && entry.fit) box.add(box_of(document, entry.id));
  }
  for (const MapEntry& entry : document.maps) {
    if (entry.visible) box.add(box_of(document, entry.id));
  }
  for (const RobotEntry& entry : document.robots) {
    if (entry.visible) box.add(box_of(document, entry.id));
  }
  return box.result();
}

std::optional<Bounds> box_of(const Document& document, const std::string& id) {
  Box box;
  if (const ScanEntry* scan = find_scan(document, id); scan && scan->scan) return bounds(*scan->scan);
  for (const PlacedPatch& placed : placed_patches(document)) {
    const bool is_of_map = placed.of == PatchOf::map && placed.owner == id;
    if (placed.id != id && !is_of_map) continue;
    const Result<Patch> patch = as_shown(document, placed);
    if (!patch) continue;
    for (const Eigen::Vector3d& point : outline_curve(*patch, 64)) box.add(point);
    box.add(centre(*patch));
  }
  if (const RobotEntry* robot = find_robot(document, id)) {
    for (const Eigen::Vector3d& point : points_of_robot(document, *robot)) box.add(point);
  }
  if (const RegionEntry* region = find_region(document, id); region && region->points) {
    const ScanEntry* scan = find_scan(document, region->scan);
    for (const std::uint32_t point : *region->points) {
      if (scan && scan->scan) box.add(scan->scan->point(point));
    }
  }
  return box.result();
}

std::optional<double> depth_seen_by_sensor(const Scan& scan) {
  const Eigen::Vector3d forward = rotation(scan.viewpoint).col(2);
  std::vector<double> depths;
  depths.reserve(scan.finite_count);
  std::size_t before = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    depths.push_back(forward.dot(scan.point(i) - scan.viewpoint.position));
    before += depths.back() > 0;
  }
  if (depths.empty() ||
      static_cast<double>(before) < share_before_sensor * static_cast<double>(depths.size())) {
    return std::nullopt;
  }
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

double point_spacing(const Scan& scan) {
  std::vector<double> steps;
  for (std::size_t i = 0; scan.organized() && i + 1 < scan.size(); i += 7) {
    const bool same_row = i % scan.width + 1 < scan.width;
    if (same_row && scan.finite[i] && scan.finite[i + 1]) {
      steps.push_back((scan.positions[i + 1] - scan.positions[i]).norm());
    }
  }
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
  }
  const std::optional<Bounds> box = bounds(scan);
  if (!box) return 0.0;
  Eigen::Vector3d sides = box->max - box->min;
  std::sort(sides.begin(), sides.end());
  return std::sqrt(sides[1] * sides[2] / static_cast<double>(scan.finite_count));
}

void turn_towards(OrbitCamera& camera, const Eigen::Vector3d& outwards) {
  const ViewCamera view = view_camera(camera, 1, 1);
  const auto& q = view.quaternion_xyzw;
  const Eigen::Vector3d now = Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Vector3d::UnitZ();
  const auto flat = [&camera](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(v - camera.up.dot(v) * camera.up);
  };
  const Eigen::Vector3d from = flat(now), to = flat(outwards);
  const double turn = std::atan2(camera.up.dot(from.cross(to)), from.dot(to));
  const double elevation = std::asin(std::clamp(camera.up.dot(outwards.normalized()), -1.0, 1.0));
  camera.orbit(turn, elevation - camera.elevation);
}

}  // namespace patchlab::viewer
