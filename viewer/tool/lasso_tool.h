// The lasso: freehand and polygon in one tool. Pure logic: pointer events in, an outcome out; knows no
// window.
//
//   drag         freehand; the release closes the contour
//   clicks       vertices; a double click, Enter or a click near the start closes it
//   rectangle    a shape of its own: a drag from corner to corner, nothing else
//   Backspace    takes the last vertex back;  Esc drops the contour
//
// The contour is anchored in the world: each vertex is kept as the point where the ray through its pixel
// meets the plane at the depth of the camera's pivot. Navigation while drawing therefore carries the contour
// along with the scene instead of losing it, and what is selected is what lies inside the contour as it is
// seen when it closes. A vertex that has gone behind the camera is left out.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/region/lasso.h"

namespace patchlab::viewer {

// How the tool sees the world at the moment of an event.
struct LassoView {
  ViewCamera camera;
  double depth = 1.0;  // m, of the pivot along the view axis
  double scale = 1.0;  // of the user interface: the thresholds below are in its pixels
};

struct Modifiers {
  bool shift = false, ctrl = false, alt = false;
};

enum class ContourShape { freehand, rectangle };

// Shift adds, Ctrl subtracts, both intersect; `otherwise` is what the tool bar says.
SelectMode mode_of(const Modifiers& modifiers, SelectMode otherwise);

// The point at a pixel and a depth (m, along the view axis): the inverse of project().
Eigen::Vector3d unproject(const ViewCamera& camera, const Eigen::Vector2d& pixel, double depth);

class LassoTool {
 public:
  enum class Outcome {
    none,
    changed,    // the contour is another one: preview it
    closed,     // finished: contour() is what the user asked for; reset() takes it off
    cancelled,  // there is no contour any more
  };
  static constexpr double drag_threshold = 5.0;   // px: a press that moves less is a click
  static constexpr double sample_distance = 3.0;  // px between freehand vertices
  static constexpr double close_distance = 10.0;  // px around the start

  Outcome press(const Eigen::Vector2d& pixel, SelectMode mode, const LassoView& view,
                ContourShape shape = ContourShape::freehand);
  Outcome move(const Eigen::Vector2d& pixel, const LassoView& view);
  Outcome release(const Eigen::Vector2d& pixel, const LassoView& view);
  Outcome double_click();  // in place of the second press
  Outcome enter();
  Outcome backspace();
  Outcome escape();
  void reset();

  bool drawing() const { return !vertices_.empty(); }
  bool dragging() const { return pressed_at_.has_value(); }
  SelectMode mode() const { return mode_; }
  // Viewport pixels of the camera given; with the pointer as a last vertex while clicks are being placed.
  std::vector<Eigen::Vector2d> contour(const ViewCamera& camera) const;
  // True where a click would close the contour: the start is drawn so.
  bool near_start(const Eigen::Vector2d& pixel, const LassoView& view) const;

 private:
  Outcome close();
  void span_rectangle(const Eigen::Vector2d& pixel, const LassoView& view);
  void append(const Eigen::Vector2d& pixel, const LassoView& view);

  std::vector<Eigen::Vector3d> vertices_;      // world
  std::optional<Eigen::Vector3d> pointer_;     // world; while no button is down
  std::optional<Eigen::Vector2d> pressed_at_;  // px; while the button is down
  bool freehand_ = false;                      // the press has become a drag
  bool started_by_drag_ = false;               // no vertex was clicked before
  SelectMode mode_ = SelectMode::set;
  ContourShape shape_ = ContourShape::freehand;
};

}  // namespace patchlab::viewer
