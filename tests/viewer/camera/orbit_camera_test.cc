#include "viewer/camera/orbit_camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/random.h"

namespace patchlab::viewer {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr int kWidth = 1280, kHeight = 800;

Vector2d pixel(const ViewCamera& camera, const Vector3d& point) {
  const Projected projected = project(camera, point);
  return {projected.x, projected.y};
}

Matrix3d world_from_view(const ViewCamera& camera) {
  const auto& q = camera.quaternion_xyzw;
  return Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
}

OrbitCamera any_camera(Random& random, bool perspective) {
  OrbitCamera camera;
  camera.pivot = 3.0 * random.normal3();
  camera.up = random.unit3();
  camera.azimuth = random.uniform(-kPi, kPi);
  camera.elevation = random.uniform(-0.5 * kPi, 0.5 * kPi);
  camera.distance = random.uniform(0.1, 5.0);
  camera.fov_y = random.uniform(0.2, 1.5);
  camera.perspective = perspective;
  return camera;
}

// A point somewhere around the pivot, in front of the eye.
Vector3d seen_point(Random& random, const OrbitCamera& camera) {
  return camera.pivot + 0.4 * camera.distance * random.uniform() * random.unit3();
}

class OrbitCameraTest : public testing::TestWithParam<bool> {
 protected:
  Random random{7};
  bool perspective() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Projections, OrbitCameraTest, testing::Bool(), [](const auto& projection) {
  return projection.param ? "Perspective" : "Orthographic";
});

TEST_P(OrbitCameraTest, MatricesAgreeWithTheLassosProjection) {
  for (int i = 0; i < 200; ++i) {
    const OrbitCamera orbit = any_camera(random, perspective());
    const ViewCamera camera = view_camera(orbit, kWidth, kHeight);
    const Vector3d point = seen_point(random, orbit);
    const Eigen::Vector4d clip = clip_from_world(camera, 1e3 * orbit.distance) * point.homogeneous();
    const Projected projected = project(camera, point);
    EXPECT_NEAR(projected.x, 0.5 * kWidth * (1.0 + clip.x() / clip.w()), 1e-9);
    EXPECT_NEAR(projected.y, 0.5 * kHeight * (1.0 - clip.y() / clip.w()), 1e-9);
    EXPECT_NEAR(projected.depth, -(view_from_world(camera) * point.homogeneous()).z(), 1e-9);
  }
}

TEST_P(OrbitCameraTest, ClipPlanesAreAtMinusOneAndOne) {
  const ViewCamera camera = view_camera(any_camera(random, perspective()), kWidth, kHeight);
  const double far_plane = 50.0;
  for (const auto& [depth, expected] : {std::pair(camera.near_plane, -1.0), std::pair(far_plane, 1.0)}) {
    const Eigen::Vector4d clip = clip_from_view(camera, far_plane) * Eigen::Vector4d(0.0, 0.0, -depth, 1.0);
    EXPECT_NEAR(clip.z() / clip.w(), expected, 1e-9);
  }
}

TEST_P(OrbitCameraTest, RayThroughAPixelMeetsThePointSeenThere) {
  for (int i = 0; i < 200; ++i) {
    const OrbitCamera orbit = any_camera(random, perspective());
    const ViewCamera camera = view_camera(orbit, kWidth, kHeight);
    const Vector3d point = seen_point(random, orbit);
    const Ray through = ray(camera, pixel(camera, point));
    const Vector3d offset = point - through.origin;
    EXPECT_NEAR(through.direction.norm(), 1.0, 1e-12);
    EXPECT_GT(offset.dot(through.direction), 0.0);
    EXPECT_LT(offset.cross(through.direction).norm(), 1e-9 * offset.norm());
  }
}

TEST_P(OrbitCameraTest, PivotIsInTheMiddle) {
  const OrbitCamera orbit = any_camera(random, perspective());
  const ViewCamera camera = view_camera(orbit, kWidth, kHeight);
  EXPECT_LT((pixel(camera, orbit.pivot) - Vector2d(0.5 * kWidth, 0.5 * kHeight)).norm(), 1e-9);
}

TEST_P(OrbitCameraTest, ProjectionsShowThePivotsPlaneAlike) {
  const OrbitCamera orbit = any_camera(random, perspective());
  OrbitCamera other = orbit;
  other.perspective = !orbit.perspective;
  const ViewCamera camera = view_camera(orbit, kWidth, kHeight);
  const Vector3d beside = orbit.pivot + 0.2 * orbit.distance * world_from_view(camera).col(0);
  EXPECT_LT((pixel(camera, beside) - pixel(view_camera(other, kWidth, kHeight), beside)).norm(), 1e-9);
}

TEST_P(OrbitCameraTest, ZoomKeepsWhatIsUnderTheCursor) {
  for (int i = 0; i < 100; ++i) {
    OrbitCamera orbit = any_camera(random, perspective());
    const Matrix3d axes = world_from_view(view_camera(orbit, kWidth, kHeight));
    const Vector3d point =
        orbit.pivot + 0.3 * orbit.distance * (random.uniform() * axes.col(0) - axes.col(1));
    const Vector2d cursor = pixel(view_camera(orbit, kWidth, kHeight), point);
    const double before = orbit.distance;
    orbit.zoom(0.8, cursor, {kWidth, kHeight});
    EXPECT_NEAR(orbit.distance, 0.8 * before, 1e-12);
    EXPECT_LT((pixel(view_camera(orbit, kWidth, kHeight), point) - cursor).norm(), 1e-8);
  }
}

TEST_P(OrbitCameraTest, ZoomAboutAnyPointKeepsIt) {
  OrbitCamera orbit = any_camera(random, perspective());
  const Vector3d point = seen_point(random, orbit);
  const Vector2d before = pixel(view_camera(orbit, kWidth, kHeight), point);
  orbit.zoom_about(0.7, point);
  EXPECT_LT((pixel(view_camera(orbit, kWidth, kHeight), point) - before).norm(), 1e-8);
}

TEST_P(OrbitCameraTest, PanFollowsTheDrag) {
  OrbitCamera orbit = any_camera(random, perspective());
  const Vector3d point = orbit.pivot;
  const Vector2d before = pixel(view_camera(orbit, kWidth, kHeight), point), drag(37.0, -91.0);
  orbit.pan(drag, kHeight);
  EXPECT_LT((pixel(view_camera(orbit, kWidth, kHeight), point) - before - drag).norm(), 1e-8);
}

TEST_P(OrbitCameraTest, OrbitNeverFlips) {
  OrbitCamera orbit = any_camera(random, perspective());
  Matrix3d before = world_from_view(view_camera(orbit, kWidth, kHeight));
  for (int i = 0; i < 2000; ++i) {
    const double climb = i / 500 % 2 == 0 ? 0.1 : -0.1;  // long against a pole, then long against the other
    orbit.orbit(random.uniform(-0.1, 0.1), climb + random.uniform(-0.1, 0.1));
    const Matrix3d axes = world_from_view(view_camera(orbit, kWidth, kHeight));
    EXPECT_GE(axes.col(1).dot(orbit.up), -1e-12) << "up is never down on the screen";
    EXPECT_NEAR(axes.col(0).dot(orbit.up), 0.0, 1e-12) << "no roll";
    EXPECT_LT(Eigen::AngleAxisd(axes.transpose() * before).angle(), 0.31) << "no jump";
    before = axes;
  }
}

TEST_P(OrbitCameraTest, OrbitKeepsPivotAndDistance) {
  OrbitCamera orbit = any_camera(random, perspective());
  const OrbitCamera before = orbit;
  orbit.orbit(0.4, -0.2);
  EXPECT_EQ(orbit.pivot, before.pivot);
  EXPECT_EQ(orbit.distance, before.distance);
  EXPECT_NEAR(std::remainder(orbit.azimuth - before.azimuth - 0.4, 2.0 * kPi), 0.0, 1e-12);
}

TEST_P(OrbitCameraTest, FrameShowsTheWholeBoxAndFillsTheView) {
  for (const double aspect : {0.5, 1.6}) {
    const int width = static_cast<int>(aspect * kHeight);
    OrbitCamera orbit = any_camera(random, perspective());
    const Vector3d min(-1.0, -2.0, 5.0), max(0.5, 4.0, 5.5);
    orbit.frame(min, max, aspect);
    const ViewCamera camera = view_camera(orbit, width, kHeight);
    double fullest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d point(corner & 1 ? max.x() : min.x(), corner & 2 ? max.y() : min.y(),
                           corner & 4 ? max.z() : min.z());
      const Vector2d seen = pixel(camera, point);
      fullest = std::max(
          {fullest, std::abs(2.0 * seen.x() / width - 1.0), std::abs(2.0 * seen.y() / kHeight - 1.0)});
    }
    EXPECT_LT(fullest, 1.0);
    EXPECT_GT(fullest, 0.8);
  }
}

TEST(OrbitCamera, FrameOfAPointKeepsTheDistance) {
  OrbitCamera orbit;
  orbit.frame(Vector3d::Ones(), Vector3d::Ones(), 1.5);
  EXPECT_EQ(orbit.pivot, Vector3d::Ones());
  EXPECT_EQ(orbit.distance, OrbitCamera{}.distance);
}

TEST(OrbitCamera, FrontRightAndTopViewsLookAlongTheAxes) {
  OrbitCamera orbit;
  orbit.elevation = 0.0;
  const auto towards_eye = [&] {
    return Vector3d(world_from_view(view_camera(orbit, kWidth, kHeight)).col(2));
  };
  EXPECT_TRUE(towards_eye().isApprox(-Vector3d::UnitY()));
  orbit.azimuth = 0.5 * kPi;
  EXPECT_TRUE(towards_eye().isApprox(Vector3d::UnitX()));
  orbit.azimuth = 0.0;
  orbit.elevation = 0.5 * kPi;
  EXPECT_TRUE(towards_eye().isApprox(Vector3d::UnitZ()));
  EXPECT_TRUE(world_from_view(view_camera(orbit, kWidth, kHeight)).col(1).isApprox(Vector3d::UnitY()));
}

TEST(OrbitCamera, AnyUpIsUpOnTheScreen) {
  for (const Vector3d& up :
       {Vector3d(0, 0, -1), Vector3d(0, -1, 0), Vector3d(1, 0, 0), Vector3d(0.6, 0, -0.8)}) {
    OrbitCamera orbit;
    orbit.up = up;
    const ViewCamera camera = view_camera(orbit, kWidth, kHeight);
    const Vector2d above = pixel(camera, orbit.pivot + 0.1 * up);
    EXPECT_LT(above.y(), 0.5 * kHeight - 10.0);
    EXPECT_NEAR(above.x(), 0.5 * kWidth, 1e-9);
  }
}

TEST(OrbitCamera, FromSensorSeesWhatTheSensorSaw) {
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(random.uniform(0.0, 3.1), random.unit3()));
    const Viewpoint viewpoint{2.0 * random.normal3(), {q.x(), q.y(), q.z(), q.w()}, true};
    const double fov_y = 0.7, focal = 0.5 * kHeight / std::tan(0.5 * fov_y);
    const ViewCamera camera = view_camera(from_sensor(viewpoint, 1.3, fov_y), kWidth, kHeight);
    EXPECT_LT((camera.position - viewpoint.position).norm(), 1e-12);
    const Vector3d seen_by_sensor(0.2, -0.1, 1.7);  // z forward, y down
    const Projected projected = project(camera, viewpoint.position + q * seen_by_sensor);
    EXPECT_NEAR(projected.x, 0.5 * kWidth + focal * seen_by_sensor.x() / seen_by_sensor.z(), 1e-8);
    EXPECT_NEAR(projected.y, 0.5 * kHeight + focal * seen_by_sensor.y() / seen_by_sensor.z(), 1e-8);
    EXPECT_NEAR(projected.depth, seen_by_sensor.z(), 1e-12);
  }
}

TEST(OrbitCamera, FlightBeginsAndEndsWhereItSaysAndTurnsTheShortWay) {
  OrbitCamera from, to;
  from.azimuth = 3.0;
  to.azimuth = -3.0;
  to.pivot = {1.0, 2.0, 3.0};
  to.distance = 0.5;
  to.up = -Vector3d::UnitY();
  const OrbitCamera begin = between(from, to, 0.0), middle = between(from, to, 0.5),
                    end = between(from, to, 1.0);
  EXPECT_NEAR(std::remainder(begin.azimuth - from.azimuth, 2.0 * kPi), 0.0, 1e-12);
  EXPECT_LT((begin.pivot - from.pivot).norm() + (begin.up - from.up).norm(), 1e-12);
  EXPECT_NEAR(std::abs(std::remainder(middle.azimuth, 2.0 * kPi)), kPi, 1e-12);
  EXPECT_NEAR(middle.up.norm(), 1.0, 1e-12);
  EXPECT_NEAR(end.azimuth, to.azimuth, 1e-12);
  EXPECT_LT((end.pivot - to.pivot).norm() + (end.up - to.up).norm(), 1e-12);
  EXPECT_NEAR(end.distance, to.distance, 1e-12);
}

}  // namespace
}  // namespace patchlab::viewer
