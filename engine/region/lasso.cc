#include "engine/region/lasso.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/region/polygon_mask.h"

namespace patchlab {
namespace {

// A camera made ready for many points.
class Projector {
 public:
  explicit Projector(const ViewCamera& camera)
      : view_from_world_(view_from_world(camera)),
        position_(camera.position),
        centre_(0.5 * camera.viewport[0], 0.5 * camera.viewport[1]),
        perspective_(camera.perspective),
        pixels_(camera.perspective ? centre_.y() / std::tan(0.5 * camera.fov_y)
                                   : camera.viewport[1] / camera.height) {}

  Projected operator()(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d q_view = view_from_world_ * (point - position_);
    const double depth = -q_view.z();
    const double scale = perspective_ ? pixels_ / depth : pixels_;
    return {centre_.x() + scale * q_view.x(), centre_.y() - scale * q_view.y(), depth};
  }

 private:
  static Eigen::Matrix3d view_from_world(const ViewCamera& camera) {
    const auto& [x, y, z, w] = camera.quaternion_xyzw;
    return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix().transpose();
  }

  Eigen::Matrix3d view_from_world_;
  Eigen::Vector3d position_;
  Eigen::Vector2d centre_;  // px
  bool perspective_;
  double pixels_;  // px at unit depth (perspective), px a metre (orthographic)
};

}  // namespace

Projected project(const ViewCamera& camera, const Eigen::Vector3d& point) { return Projector(camera)(point); }

bool inside_polygon(const std::vector<Eigen::Vector2d>& contour, double x, double y) {
  return inside_polygon(polygon_edges(contour), x, y);
}

std::vector<std::uint32_t> select_lasso(const Scan& scan, const ViewCamera& camera,
                                        const std::vector<Eigen::Vector2d>& contour) {
  std::vector<std::uint32_t> selected;
  if (contour.size() < 3) return selected;
  const PolygonMask mask(contour);
  const Projector project_point(camera);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    const Projected pixel = project_point(scan.point(i));
    const bool in = pixel.depth > camera.near_plane && mask.contains(pixel.x, pixel.y);
    if (in) selected.push_back(static_cast<std::uint32_t>(i));
  }
  return selected;
}

std::vector<std::uint32_t> combine(const std::vector<std::uint32_t>& before,
                                   const std::vector<std::uint32_t>& selected, SelectMode mode) {
  std::vector<std::uint32_t> after;
  const auto out = std::back_inserter(after);
  switch (mode) {
    case SelectMode::set:
      return selected;
    case SelectMode::add:
      std::set_union(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
    case SelectMode::subtract:
      std::set_difference(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
    case SelectMode::intersect:
      std::set_intersection(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
  }
  return after;
}

}  // namespace patchlab
