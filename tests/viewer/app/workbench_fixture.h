// A workbench with the ball open, for the tests of what it does.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "tests/viewer/app/ball_scan.h"
#include "viewer/app/workbench.h"
#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {

class WorkbenchTest : public testing::Test {
 protected:
  WorkbenchTest() {
    bench_.choose({SurfaceRequest::sphere, true});
    bench_.open(folder_.ball());
    finish();
  }

  void finish() {
    while (!bench_.idle()) {
      bench_.deliver();
      std::this_thread::yield();
    }
    bench_.deliver();
    for (const Error& error : bench_.take_errors()) errors_.push_back(error.message);
  }

  // A square of the screen of the sensor: the ball is 39 pixels wide there.
  Stroke square(double half_width, SelectMode mode = SelectMode::set) const {
    const ViewCamera camera = view_camera(from_sensor({}, 0.8, 2 * std::atan(120 / 262.5)), 320, 240);
    const double h = half_width;
    return {mode, {{160 - h, 120 - h}, {160 + h, 120 - h}, {160 + h, 120 + h}, {160 - h, 120 + h}}, camera};
  }
  // Nearly the whole picture, through the ball to the wall.
  Stroke wall() const { return square(115); }
  Document kept() const { return bench_.session().document(); }

  TestFolder folder_;
  std::vector<std::string> errors_;
  Workbench bench_{{folder_.path() / "state", true}, [] {}};
};

}  // namespace patchlab::viewer
