#include "viewer/tool/pick.h"

#include <gtest/gtest.h>

#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {
namespace {

// Looks along +z from the origin, 90 degrees high.
ViewCamera along_z() {
  ViewCamera camera;
  camera.quaternion_xyzw = {1, 0, 0, 0};
  camera.fov_y = 1.5707963267948966;
  camera.viewport = {600, 600};
  return camera;
}

Scan scan_of(std::vector<Eigen::Vector3f> points) {
  Scan scan;
  scan.positions = std::move(points);
  for (const Eigen::Vector3f& p : scan.positions) scan.finite.push_back(p.allFinite());
  return scan;
}

TEST(PickPoint, TakesTheOneInFrontOfTwoUnderThePointer) {
  const Scan scan = scan_of({{0, 0, 2}, {0, 0, 1}, {0, 0, 3}});
  EXPECT_EQ(pick_point(scan, along_z(), {300, 300}, 12), 1u);
}

TEST(PickPoint, ForgivesAPointerThatIsAFewPixelsOff) {
  const Scan scan = scan_of({{0, 0, 1}});
  EXPECT_EQ(pick_point(scan, along_z(), {308, 300}, 12), 0u);
  EXPECT_EQ(pick_point(scan, along_z(), {340, 300}, 12), std::nullopt);
}

TEST(PickPoint, NeverTakesWhatIsBehindOrNotFinite) {
  const Scan scan = scan_of({{0, 0, -1}, {0, 0, std::numeric_limits<float>::quiet_NaN()}});
  EXPECT_EQ(pick_point(scan, along_z(), {300, 300}, 12), std::nullopt);
}

PatchEntry sphere(const std::string& id, double z) {
  const PatchTypeRow& type = *find_patch_type(SurfaceType::sphere, BoundaryType::circle);
  Boundary circle{BoundaryType::circle, BoundaryVector::Constant(1, 0.1)};
  Eigen::Matrix3d R = Eigen::Vector3d(1, -1, -1).asDiagonal();  // z_l towards the camera
  FitResult fit;
  fit.patch = make_patch(type, circle, Eigen::VectorXd::Constant(1, -5.0), R, {0, 0, z});
  PatchEntry entry;
  entry.id = id;
  entry.fit = std::make_shared<const FitResult>(fit);
  return entry;
}

TEST(PickPatch, TakesTheNearestVisibleOne) {
  Document document;
  document.patches = {sphere("patch-1", 2.0), sphere("patch-2", 1.0)};
  EXPECT_EQ(pick_patch(document, along_z(), {300, 300}), "patch-2");
  document.patches[1].visible = false;
  EXPECT_EQ(pick_patch(document, along_z(), {300, 300}), "patch-1");
  EXPECT_EQ(pick_patch(document, along_z(), {10, 10}), std::nullopt);
}

}  // namespace
}  // namespace patchlab::viewer
