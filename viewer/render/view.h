// What every pass needs of the camera.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/region/lasso.h"
#include "viewer/render/program.h"
#include "viewer/render/renderer.h"

namespace patchlab::viewer {

using Box = Eigen::AlignedBox3f;

struct View {
  Eigen::Matrix4f clip_from_view, view_from_local;  // local: about the origin of the scene
  float near_depth;                                 // m, the near plane, close before what is drawn
  float nearest, farthest;                          // m, depths of what is drawn
  float height;                                     // m, of the viewport at `nearest`
  bool perspective;
  Viewport viewport;
};

// `local` is the box of all that is drawn; the clip planes are put close around it, but never before the
// camera's near.
View make_view(const ViewCamera& camera, const Viewport& viewport, const Eigen::Vector3d& origin,
               const Box& local);

// Sets the uniforms clip_from_view and view_from_local of the program in use.
void set_view(const Program& program, const View& view);

// How points fade into the background: by kFarthestFade where they are `depth` behind the nearest thing, or
// more.
struct PointFade {
  static constexpr float kFarthest = 0.35f;
  Eigen::Vector3f background;
  float nearest, depth;  // m
  bool operator==(const PointFade&) const = default;
};
PointFade point_fade(const View& view, const Scene& scene);

}  // namespace patchlab::viewer
