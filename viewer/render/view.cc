#include "viewer/render/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {
namespace {

struct DepthRange {
  double nearest, farthest;
};

// Of the box, between the planes of the camera.
DepthRange depth_range(const Eigen::Matrix4d& view_from_local, const Box& local, const ViewCamera& camera) {
  DepthRange range{std::numeric_limits<double>::max(), camera.near_plane};
  for (int corner = 0; corner < 8 && !local.isEmpty(); ++corner) {
    const Eigen::Vector3d point = local.corner(static_cast<Box::CornerType>(corner)).cast<double>();
    const double depth = -(view_from_local * point.homogeneous()).z();
    range.nearest = std::min(range.nearest, depth);
    range.farthest = std::max(range.farthest, depth);
  }
  range.farthest = std::min(range.farthest, camera.far_plane);
  range.nearest = std::clamp(range.nearest, camera.near_plane, range.farthest);
  return range;
}

}  // namespace

View make_view(const ViewCamera& camera, const Viewport& viewport, const Eigen::Vector3d& origin,
               const Box& local) {
  Eigen::Matrix4d world_from_local = Eigen::Matrix4d::Identity();
  world_from_local.topRightCorner<3, 1>() = origin;
  const Eigen::Matrix4d view_from_local = view_from_world(camera) * world_from_local;
  const DepthRange range = depth_range(view_from_local, local, camera);

  const double slack = 0.01 * (range.farthest - range.nearest) + camera.near_plane;
  ViewCamera close = camera;
  close.viewport = {viewport.width, viewport.height};
  close.near_plane = std::max(range.nearest - slack, camera.near_plane);
  View view;
  view.clip_from_view =
      clip_from_view(close, std::min(range.farthest + slack, camera.far_plane)).cast<float>();
  view.view_from_local = view_from_local.cast<float>();
  view.near_depth = static_cast<float>(close.near_plane);
  view.nearest = static_cast<float>(range.nearest);
  view.farthest = static_cast<float>(range.farthest);
  const double height =
      camera.perspective ? 2.0 * range.nearest * std::tan(0.5 * camera.fov_y) : camera.height;
  view.height = static_cast<float>(height);
  view.perspective = camera.perspective;
  view.viewport = viewport;
  return view;
}

void set_view(const Program& program, const View& view) {
  program.set("clip_from_view", view.clip_from_view);
  program.set("view_from_local", view.view_from_local);
}

PointFade point_fade(const View& view, const Scene& scene) {
  PointFade fade;
  for (std::size_t k = 0; k < 3; ++k)
    fade.background[static_cast<int>(k)] = 0.5f * (scene.background_top[k] + scene.background_bottom[k]);
  fade.nearest = view.nearest;
  fade.depth = scene.fades ? std::max(view.farthest - view.nearest, view.height) : 1e30f;
  return fade;
}

}  // namespace patchlab::viewer
