// A camera made ready for many points.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "engine/region/lasso.h"

namespace patchlab {

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

  // A point q about `origin` as x right, y down, depth in the frame of the view: this times (q, 1).
  Eigen::Matrix<double, 3, 4> view_from(const Eigen::Vector3d& origin) const {
    Eigen::Matrix<double, 3, 4> view;
    view << view_from_world_, view_from_world_ * (origin - position_);
    view.bottomRows<2>() *= -1.0;
    return view;
  }
  const Eigen::Vector2d& centre() const { return centre_; }  // px
  double pixels() const { return pixels_; }  // at unit depth (perspective), a metre (orthographic)

  // What a pixel covers across the view at a depth, m.
  double footprint(double depth) const { return perspective_ ? depth / pixels_ : 1.0 / pixels_; }

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

}  // namespace patchlab
