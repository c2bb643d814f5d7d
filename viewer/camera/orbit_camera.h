// The orbit camera: turntable about a pivot. Value type; knows no window and no GL.
//
// At azimuth 0 and elevation 0 it looks along +y where up is z (a front view), along +z where up is -y (the
// optical frame of a sensor). It never rolls, so up is never down on the screen.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/region/lasso.h"

namespace patchlab::viewer {

struct OrbitCamera {
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  // m, in the frame of the points
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();    // turntable axis, unit
  double azimuth = 0.0;    // rad, about up; pi/2: the eye is to the right of the front
  double elevation = 0.3;  // rad, in [-pi/2, pi/2]
  double distance = 2.0;   // m, from the pivot
  double fov_y = 0.8;      // rad
  bool perspective = true;

  bool operator==(const OrbitCamera&) const = default;

  // The eye moves to its right and upwards about the pivot, rad; elevation stops at the poles.
  void orbit(double right, double up_by);
  // The pivot's plane follows a drag of `pixels` (x right, y down) in a viewport of that height.
  void pan(const Eigen::Vector2d& pixels, double viewport_height);
  // Wheel: towards the point of the pivot's plane under the cursor, which stays under it; factor < 1 is
  // nearer.
  void zoom(double factor, const Eigen::Vector2d& cursor, const Eigen::Vector2d& viewport);
  // The same towards any point: it stays where it is on the screen.
  void zoom_about(double factor, const Eigen::Vector3d& fixed);
  // Shows the whole box from the present side; aspect is width / height of the viewport.
  void frame(const Eigen::Vector3d& min, const Eigen::Vector3d& max, double aspect);
};

// Part of the way from one camera to another (0: from, 1: to), for a short flight.
OrbitCamera between(const OrbitCamera& from, const OrbitCamera& to, double part);

// A layer of the scene, as thick as it is before and behind the plane of the pivot: what is not in it is
// neither drawn nor selected.
struct DepthSlab {
  double front, back;  // m, positive
};

// What the journal, the lasso and the renderer take. `viewport` in pixels.
ViewCamera view_camera(const OrbitCamera& camera, int viewport_width, int viewport_height,
                       const std::optional<DepthSlab>& slab = {});
// The camera that sees what the sensor saw: at the viewpoint, turned as the sensor, pivot at `depth` in front
// of it.
OrbitCamera from_sensor(const Viewpoint& viewpoint, double depth, double fov_y);

// OpenGL clip coordinates; precondition: far_plane > near_plane of the camera.
Eigen::Matrix4d clip_from_view(const ViewCamera& camera, double far_plane);
Eigen::Matrix4d clip_from_world(const ViewCamera& camera, double far_plane);
Eigen::Matrix4d view_from_world(const ViewCamera& camera);
// Ray through a point of the viewport (pixels, x right, y down from the upper left corner), direction unit.
struct Ray {
  Eigen::Vector3d origin, direction;
};
Ray ray(const ViewCamera& camera, const Eigen::Vector2d& pixel);

}  // namespace patchlab::viewer
