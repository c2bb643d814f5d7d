// The orbit camera: turntable about a pivot. Value type; knows no window and no GL.
#pragma once

#include <Eigen/Core>

#include "engine/region/lasso.h"

namespace patchlab::viewer {

struct OrbitCamera {
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  // m, in the frame of the points
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();    // turntable axis, unit
  double azimuth = 0.0;                             // rad, about up
  double elevation = 0.3;                           // rad, in (-pi/2, pi/2)
  double distance = 2.0;                            // m, from the pivot
  double fov_y = 0.8;                               // rad
  bool perspective = true;

  void orbit(double right, double up_by);                       // rad
  void pan(const Eigen::Vector2d& pixels, double viewport_height);
  // Wheel: towards what is under the cursor, which stays under it; factor < 1 is nearer.
  void zoom(double factor, const Eigen::Vector2d& cursor, const Eigen::Vector2d& viewport);
  void frame(const Eigen::Vector3d& min, const Eigen::Vector3d& max, double aspect);  // shows the whole box
};

// What the journal, the lasso and the renderer take. `viewport` in pixels.
ViewCamera view_camera(const OrbitCamera& camera, int viewport_width, int viewport_height);
// The camera that sees what the sensor saw: at the viewpoint, turned as the sensor, pivot at `depth` in front of it.
OrbitCamera from_sensor(const Viewpoint& viewpoint, double depth, double fov_y);

Eigen::Matrix4d clip_from_world(const ViewCamera& camera, double far_plane);
Eigen::Matrix4d view_from_world(const ViewCamera& camera);
// Ray through a viewport pixel, direction unit.
struct Ray {
  Eigen::Vector3d origin, direction;
};
Ray ray(const ViewCamera& camera, const Eigen::Vector2d& pixel);

}  // namespace patchlab::viewer
