#include "viewer/tool/lasso_tool.h"

#include <cmath>

#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {

namespace {

constexpr std::size_t least_vertices = 3;

constexpr double steps_a_pixel = 100.0;  // what a journal keeps of a contour

std::optional<Eigen::Vector2d> pixel_of(const ViewCamera& camera, const Eigen::Vector3d& point) {
  const Projected p = project(camera, point);
  if (p.depth <= camera.near_plane) return std::nullopt;
  return Eigen::Vector2d(std::round(p.x * steps_a_pixel), std::round(p.y * steps_a_pixel)) / steps_a_pixel;
}

}  // namespace

SelectMode mode_of(const Modifiers& modifiers, SelectMode otherwise) {
  if (modifiers.shift && modifiers.ctrl) return SelectMode::intersect;
  if (modifiers.shift) return SelectMode::add;
  if (modifiers.ctrl) return SelectMode::subtract;
  return otherwise;
}

Eigen::Vector3d unproject(const ViewCamera& camera, const Eigen::Vector2d& pixel, double depth) {
  const Ray through = ray(camera, pixel);
  const double start = project(camera, through.origin).depth;
  const double slope = project(camera, through.origin + through.direction).depth - start;
  return through.origin + through.direction * ((depth - start) / slope);
}

LassoTool::Outcome LassoTool::press(const Eigen::Vector2d& pixel, SelectMode mode, const LassoView& view,
                                    ContourShape shape) {
  if (!drawing()) shape_ = shape;
  if (vertices_.size() >= least_vertices && near_start(pixel, view)) return close();
  if (!drawing()) mode_ = mode;
  started_by_drag_ = !drawing();
  pressed_at_ = pixel;
  freehand_ = false;
  append(pixel, view);
  return Outcome::changed;
}

LassoTool::Outcome LassoTool::move(const Eigen::Vector2d& pixel, const LassoView& view) {
  if (!drawing()) return Outcome::none;
  if (!dragging()) {
    pointer_ = unproject(view.camera, pixel, view.depth);
    return Outcome::changed;
  }
  freehand_ = freehand_ || (pixel - *pressed_at_).norm() > drag_threshold * view.scale;
  if (!freehand_) return Outcome::none;
  if (shape_ == ContourShape::rectangle) {
    span_rectangle(pixel, view);
    return Outcome::changed;
  }
  const std::optional<Eigen::Vector2d> last = pixel_of(view.camera, vertices_.back());
  if (last && (pixel - *last).norm() < sample_distance * view.scale) return Outcome::none;
  append(pixel, view);
  return Outcome::changed;
}

LassoTool::Outcome LassoTool::release(const Eigen::Vector2d& pixel, const LassoView& view) {
  if (!dragging()) return Outcome::none;
  pressed_at_.reset();
  if (shape_ == ContourShape::rectangle) return freehand_ ? close() : escape();
  if (!freehand_) return Outcome::none;
  if (!started_by_drag_ && !near_start(pixel, view)) return Outcome::changed;
  return close();
}

LassoTool::Outcome LassoTool::double_click() { return drawing() ? close() : Outcome::none; }

LassoTool::Outcome LassoTool::enter() { return drawing() ? close() : Outcome::none; }

LassoTool::Outcome LassoTool::backspace() {
  if (vertices_.size() <= 1) return escape();
  vertices_.pop_back();
  return Outcome::changed;
}

LassoTool::Outcome LassoTool::escape() {
  if (!drawing()) return Outcome::none;
  reset();
  return Outcome::cancelled;
}

void LassoTool::reset() { *this = LassoTool(); }

LassoTool::Outcome LassoTool::close() {
  if (vertices_.size() < least_vertices) return escape();
  pointer_.reset();
  pressed_at_.reset();
  return Outcome::closed;
}

void LassoTool::span_rectangle(const Eigen::Vector2d& pixel, const LassoView& view) {
  vertices_.clear();
  const Eigen::Vector2d& from = *pressed_at_;
  for (const Eigen::Vector2d& corner :
       {from, Eigen::Vector2d(pixel.x(), from.y()), pixel, Eigen::Vector2d(from.x(), pixel.y())}) {
    append(corner, view);
  }
}

void LassoTool::append(const Eigen::Vector2d& pixel, const LassoView& view) {
  pointer_.reset();
  vertices_.push_back(unproject(view.camera, pixel, view.depth));
}

bool LassoTool::near_start(const Eigen::Vector2d& pixel, const LassoView& view) const {
  if (!drawing()) return false;
  const std::optional<Eigen::Vector2d> start = pixel_of(view.camera, vertices_.front());
  return start && (pixel - *start).norm() < close_distance * view.scale;
}

std::vector<Eigen::Vector2d> LassoTool::contour(const ViewCamera& camera) const {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(vertices_.size() + 1);
  for (const Eigen::Vector3d& vertex : vertices_)
    if (const auto pixel = pixel_of(camera, vertex)) pixels.push_back(*pixel);
  if (pointer_)
    if (const auto pixel = pixel_of(camera, *pointer_)) pixels.push_back(*pixel);
  return pixels;
}

}  // namespace patchlab::viewer
