#include "viewer/tool/navigation.h"

#include <cmath>

namespace patchlab::viewer {

bool Navigation::press(Button button, const Modifiers& modifiers, const Eigen::Vector2d& pixel,
                       bool left_navigates) {
  if (active()) return true;
  if (button == Button::left && !modifiers.alt && !left_navigates) return false;
  drag_ = button == Button::middle || modifiers.shift ? Drag::move : Drag::turn;
  button_ = button;
  last_ = pixel;
  return true;
}

bool Navigation::move(OrbitCamera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector2d& viewport) {
  const Eigen::Vector2d moved = pixel - last_;
  if (!active() || moved.isZero()) return false;
  last_ = pixel;
  if (drag_ == Drag::move) {
    camera.pan(moved, viewport.y());
  } else {
    camera.orbit(-moved.x() * turn_per_height / viewport.y(), moved.y() * turn_per_height / viewport.y());
  }
  return true;
}

void Navigation::release(Button button) {
  if (button == button_) drag_ = Drag::none;
}

void Navigation::wheel(OrbitCamera& camera, double notches, const Eigen::Vector2d& pixel,
                       const Eigen::Vector2d& viewport) {
  camera.zoom(std::pow(wheel_step, notches), pixel, viewport);
}

}  // namespace patchlab::viewer
