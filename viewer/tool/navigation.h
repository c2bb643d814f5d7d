// Navigation by mouse: which gesture moves the camera, and how. Pure logic.
//
//   any tool     right drag or Alt + left drag turns, middle drag moves, the wheel zooms to the cursor
//   orbit tool   left drag turns
// With Shift, what turns moves.
#pragma once

#include <Eigen/Core>

#include "viewer/camera/orbit_camera.h"
#include "viewer/tool/lasso_tool.h"

namespace patchlab::viewer {

enum class Button { left, right, middle };

class Navigation {
 public:
  static constexpr double wheel_step = 0.88;       // of the distance, a notch
  static constexpr double turn_per_height = 3.14;  // rad, for a drag as long as the viewport is high

  // True where the press starts a navigation; `left_navigates`: the left button is not the tool's.
  bool press(Button button, const Modifiers& modifiers, const Eigen::Vector2d& pixel, bool left_navigates);
  // Moves the camera while a navigation is under way; true where it did.
  bool move(OrbitCamera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector2d& viewport);
  void release(Button button);
  bool active() const { return drag_ != Drag::none; }

  static void wheel(OrbitCamera& camera, double notches, const Eigen::Vector2d& pixel,
                    const Eigen::Vector2d& viewport);

 private:
  enum class Drag { none, turn, move };
  Drag drag_ = Drag::none;
  Button button_ = Button::left;
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
};

}  // namespace patchlab::viewer
