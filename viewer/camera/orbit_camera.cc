#include "viewer/camera/orbit_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/pose/rotation.h"

namespace patchlab::viewer {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMargin = 1.08;
// How far the eye of an orthographic camera stands back, in distances, so that nothing it shows is behind it.
constexpr double kOrthographicRetreat = 100.0;

// Directions of the eye from the pivot at azimuth 0 and pi/2, elevation 0.
struct Turntable {
  Vector3d front, right;
};

Turntable turntable(const Vector3d& up) {
  const bool upside_down = up.z() < -1.0 + 1e-12;
  const Matrix3d up_from_z =
      upside_down ? Vector3d(1, -1, -1).asDiagonal().toDenseMatrix() : shortest_turn(Vector3d::UnitZ(), up);
  const Vector3d front = up_from_z * -Vector3d::UnitY();
  return {front, up.cross(front)};
}

// Columns: the view's x (right), y (up) and z (towards the eye).
Matrix3d world_from_view(const OrbitCamera& camera) {
  const auto [front, right] = turntable(camera.up);
  const double ca = std::cos(camera.azimuth), sa = std::sin(camera.azimuth);
  const double ce = std::cos(camera.elevation), se = std::sin(camera.elevation);
  const Vector3d outwards = ca * front + sa * right;
  Matrix3d axes;
  axes.col(0) = ca * right - sa * front;
  axes.col(1) = ce * camera.up - se * outwards;
  axes.col(2) = ce * outwards + se * camera.up;
  return axes;
}

double metres_per_pixel(const OrbitCamera& camera, double viewport_height) {
  return 2.0 * camera.distance * std::tan(0.5 * camera.fov_y) / viewport_height;
}

Quaterniond quaternion(const ViewCamera& camera) {
  const auto& q = camera.quaternion_xyzw;
  return Quaterniond(q[3], q[0], q[1], q[2]).normalized();
}

// World height of the viewport at unit depth (perspective) or at any (orthographic).
double view_height(const ViewCamera& camera) {
  return camera.perspective ? 2.0 * std::tan(0.5 * camera.fov_y) : camera.height;
}

double mix(double a, double b, double part) { return a + part * (b - a); }

}  // namespace

void OrbitCamera::orbit(double right, double up_by) {
  constexpr double pi = std::numbers::pi;
  azimuth = std::remainder(azimuth + right, 2.0 * pi);
  elevation = std::clamp(elevation + up_by, -0.5 * pi, 0.5 * pi);
}

void OrbitCamera::pan(const Vector2d& pixels, double viewport_height) {
  const Matrix3d axes = world_from_view(*this);
  pivot += metres_per_pixel(*this, viewport_height) * (pixels.y() * axes.col(1) - pixels.x() * axes.col(0));
}

void OrbitCamera::zoom(double factor, const Vector2d& cursor, const Vector2d& viewport) {
  const Vector2d from_centre = cursor - 0.5 * viewport;
  const Matrix3d axes = world_from_view(*this);
  const Vector3d offset = from_centre.x() * axes.col(0) - from_centre.y() * axes.col(1);
  zoom_about(factor, pivot + metres_per_pixel(*this, viewport.y()) * offset);
}

void OrbitCamera::zoom_about(double factor, const Vector3d& fixed) {
  pivot = fixed + factor * (pivot - fixed);
  distance *= factor;
}

void OrbitCamera::frame(const Vector3d& min, const Vector3d& max, double aspect) {
  pivot = 0.5 * (min + max);
  const Matrix3d axes = world_from_view(*this);
  const double tan_y = std::tan(0.5 * fov_y), tan_x = aspect * tan_y;
  double needed = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    const Vector3d seen = axes.transpose() * side.cwiseProduct(max - min);
    const double nearer = perspective ? seen.z() : 0.0;
    needed = std::max({needed, nearer + std::abs(seen.x()) / tan_x, nearer + std::abs(seen.y()) / tan_y});
  }
  if (needed > 0.0) distance = kMargin * needed;
}

OrbitCamera between(const OrbitCamera& from, const OrbitCamera& to, double part) {
  OrbitCamera camera = to;
  const double turn = std::remainder(to.azimuth - from.azimuth, 2.0 * std::numbers::pi);
  camera.pivot = from.pivot + part * (to.pivot - from.pivot);
  camera.up = Quaterniond::Identity().slerp(part, Quaterniond(shortest_turn(from.up, to.up))) * from.up;
  camera.azimuth = to.azimuth - (1.0 - part) * turn;
  camera.elevation = mix(from.elevation, to.elevation, part);
  camera.distance = from.distance * std::pow(to.distance / from.distance, part);
  camera.fov_y = mix(from.fov_y, to.fov_y, part);
  return camera;
}

ViewCamera view_camera(const OrbitCamera& camera, int viewport_width, int viewport_height,
                       const std::optional<DepthSlab>& slab) {
  const Matrix3d axes = world_from_view(camera);
  const Quaterniond q(axes);
  const double retreat = camera.perspective ? camera.distance : kOrthographicRetreat * camera.distance;
  ViewCamera view;
  view.position = camera.pivot + retreat * axes.col(2);
  view.quaternion_xyzw = {q.x(), q.y(), q.z(), q.w()};
  view.fov_y = camera.fov_y;
  view.near_plane = 0.005 * camera.distance;
  view.perspective = camera.perspective;
  view.height = metres_per_pixel(camera, 1.0);
  view.viewport = {viewport_width, viewport_height};
  if (!slab) return view;
  view.near_plane = std::max(view.near_plane, retreat - slab->front);
  view.far_plane = retreat + slab->back;
  return view;
}

OrbitCamera from_sensor(const Viewpoint& viewpoint, double depth, double fov_y) {
  const Matrix3d world_from_sensor = rotation(viewpoint);
  const Vector3d forward = world_from_sensor.col(2);
  OrbitCamera camera;
  camera.pivot = viewpoint.position + depth * forward;
  camera.up = -world_from_sensor.col(1);
  const auto [front, right] = turntable(camera.up);
  camera.azimuth = std::atan2(-forward.dot(right), -forward.dot(front));
  camera.elevation = 0.0;
  camera.distance = depth;
  camera.fov_y = fov_y;
  return camera;
}

Matrix4d clip_from_view(const ViewCamera& camera, double far_plane) {
  const double near_plane = camera.near_plane, depth = far_plane - near_plane;
  const double scale_y = 2.0 / view_height(camera);
  Matrix4d clip = Matrix4d::Zero();
  clip(0, 0) = scale_y * camera.viewport[1] / camera.viewport[0];
  clip(1, 1) = scale_y;
  clip(2, 2) = camera.perspective ? -(far_plane + near_plane) / depth : -2.0 / depth;
  clip(2, 3) = camera.perspective ? -2.0 * far_plane * near_plane / depth : -(far_plane + near_plane) / depth;
  clip(3, camera.perspective ? 2 : 3) = camera.perspective ? -1.0 : 1.0;
  return clip;
}

Matrix4d view_from_world(const ViewCamera& camera) {
  const Matrix3d turn = quaternion(camera).conjugate().toRotationMatrix();
  Matrix4d view = Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = turn;
  view.topRightCorner<3, 1>() = -turn * camera.position;
  return view;
}

Matrix4d clip_from_world(const ViewCamera& camera, double far_plane) {
  return clip_from_view(camera, far_plane) * view_from_world(camera);
}

Ray ray(const ViewCamera& camera, const Vector2d& pixel) {
  const double per_pixel = view_height(camera) / camera.viewport[1];
  const double x = per_pixel * (pixel.x() - 0.5 * camera.viewport[0]);
  const double y = per_pixel * (0.5 * camera.viewport[1] - pixel.y());
  const Quaterniond turn = quaternion(camera);
  if (camera.perspective) return {camera.position, (turn * Vector3d(x, y, -1.0)).normalized()};
  return {camera.position + turn * Vector3d(x, y, 0.0), turn * -Vector3d::UnitZ()};
}

}  // namespace patchlab::viewer
