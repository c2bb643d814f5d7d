#include "viewer/tool/navigation.h"

#include <gtest/gtest.h>

namespace patchlab::viewer {
namespace {

const Eigen::Vector2d viewport(800, 600);

TEST(Navigation, TheLeftButtonIsTheToolsUnlessAltIsHeld) {
  Navigation navigation;
  EXPECT_FALSE(navigation.press(Button::left, {}, {0, 0}, false));
  EXPECT_FALSE(navigation.active());
  EXPECT_TRUE(navigation.press(Button::left, {.alt = true}, {0, 0}, false));
  EXPECT_TRUE(navigation.active());
}

TEST(Navigation, RightTurnsAndMiddleMoves) {
  OrbitCamera camera;
  const OrbitCamera before = camera;
  Navigation navigation;
  navigation.press(Button::right, {}, {100, 100}, false);
  EXPECT_TRUE(navigation.move(camera, {150, 100}, viewport));
  EXPECT_LT(camera.azimuth, before.azimuth);  // the scene follows the drag to the right: the eye goes left
  EXPECT_EQ(camera.pivot, before.pivot);
  navigation.release(Button::right);
  EXPECT_FALSE(navigation.move(camera, {200, 100}, viewport));

  camera = before;
  navigation.press(Button::middle, {}, {100, 100}, false);
  navigation.move(camera, {150, 100}, viewport);
  EXPECT_EQ(camera.azimuth, before.azimuth);
  EXPECT_NE(camera.pivot, before.pivot);
}

TEST(Navigation, ShiftTurnsATurnIntoAMove) {
  OrbitCamera camera;
  Navigation navigation;
  navigation.press(Button::right, {.shift = true}, {100, 100}, false);
  navigation.move(camera, {150, 130}, viewport);
  EXPECT_EQ(camera.azimuth, OrbitCamera().azimuth);
  EXPECT_NE(camera.pivot, OrbitCamera().pivot);
}

TEST(Navigation, AnotherButtonsReleaseDoesNotEndIt) {
  Navigation navigation;
  navigation.press(Button::right, {}, {0, 0}, false);
  navigation.release(Button::left);
  EXPECT_TRUE(navigation.active());
}

TEST(Navigation, TheWheelComesNearerByNotchesAndBackAgain) {
  OrbitCamera camera;
  Navigation::wheel(camera, 3, {400, 300}, viewport);
  EXPECT_LT(camera.distance, OrbitCamera().distance);
  Navigation::wheel(camera, -3, {400, 300}, viewport);
  EXPECT_NEAR(camera.distance, OrbitCamera().distance, 1e-12);
}

}  // namespace
}  // namespace patchlab::viewer
