#include "viewer/app/app.h"
#include "viewer/tool/pick.h"

namespace patchlab::viewer {

namespace {

constexpr double pick_window = 12.0;  // px, times the scale

Modifiers modifiers() {
  const ImGuiIO& io = ImGui::GetIO();
  return {io.KeyShift, io.KeyCtrl, io.KeyAlt};
}

bool any_popup() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool pressed(const ActionRow& action) {
  const ImGuiIO& io = ImGui::GetIO();
  if (action.key == 0 || io.KeyCtrl != action.ctrl || io.KeyShift != action.shift || io.KeyAlt) return false;
  const bool repeats = action.action == Action::undo || action.action == Action::redo;
  return ImGui::IsKeyPressed(action.key, repeats) ||
         (action.also && ImGui::IsKeyPressed(action.also, repeats));
}

}  // namespace

Eigen::Vector2d App::pointer() const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {mouse.x - layout_.view.x, mouse.y - layout_.view.y};
}

LassoView App::lasso_view() const {
  return {view(), project(view(), stage_.camera.pivot).depth, platform_.scale()};
}

void App::handle_keys() {
  if (ImGui::GetIO().WantTextInput || any_popup()) return;
  for (const ActionRow& action : action_table()) {
    if (pressed(action) && is_possible(action.action, workbench_.document(), state_)) act(action.action);
  }
}

void App::handle_pointer() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over_view = !io.WantCaptureMouse && layout_.view.contains(io.MousePos.x, io.MousePos.y);
  state_.contour_mode = lasso_.drawing() ? lasso_.mode() : mode_of(modifiers(), state_.mode);
  state_.contour_closes =
      lasso_.drawing() && !lasso_.dragging() && lasso_.near_start(pointer(), lasso_view());
  const Eigen::Vector2d size(layout_.view.width, layout_.view.height);
  if (over_view && io.MouseWheel != 0) Navigation::wheel(stage_.camera, io.MouseWheel, pointer(), size);
  if (navigation_.move(stage_.camera, pointer(), size)) stage_.interrupt();
  const bool moved = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
  if (moved && !navigation_.active() && (over_view || lasso_.dragging()))
    lasso(lasso_.move(pointer(), lasso_view()));
  for (const auto& [button, index] :
       {std::pair{Button::left, ImGuiMouseButton_Left}, std::pair{Button::right, ImGuiMouseButton_Right},
        std::pair{Button::middle, ImGuiMouseButton_Middle}}) {
    if (over_view && ImGui::IsMouseClicked(index)) press(button);
    if (ImGui::IsMouseReleased(index)) release(button);
  }
}

void App::press(Button button) {
  const bool left = button == Button::left;
  if (left && ImGui::GetIO().MouseDoubleClicked[ImGuiMouseButton_Left] && !modifiers().alt)
    return double_click();
  if (navigation_.press(button, modifiers(), pointer(), state_.tool == Tool::orbit)) {
    if (left) pressed_ = pointer();
    return;
  }
  if (state_.tool == Tool::surface || state_.tool == Tool::measure) {
    pressed_ = pointer();
    return;
  }
  const ContourShape shape =
      state_.tool == Tool::rectangle ? ContourShape::rectangle : ContourShape::freehand;
  lasso(lasso_.press(pointer(), mode_of(modifiers(), state_.mode), lasso_view(), shape));
}

void App::release(Button button) {
  navigation_.release(button);
  if (button != Button::left) return;
  const double reach = LassoTool::drag_threshold * platform_.scale();
  const bool clicked = pressed_ && (pointer() - *pressed_).norm() < reach;
  if (clicked && state_.tool == Tool::orbit) click();
  if (clicked && state_.tool == Tool::surface) select_surface();
  if (clicked && state_.tool == Tool::measure) measure();
  pressed_.reset();
  lasso(lasso_.release(pointer(), lasso_view()));
}

// Closes a contour that can be closed; elsewhere the point under the pointer becomes the pivot.
void App::double_click() {
  const LassoTool::Outcome outcome = lasso_.double_click();
  lasso(outcome);
  if (outcome == LassoTool::Outcome::closed) return;
  if (const std::optional<Pointed> pointed = point_under_pointer()) stage_.set_pivot(pointed->point);
}

// Of all scans that are shown, the nearest.
std::optional<App::Pointed> App::point_under_pointer() const {
  std::optional<Pointed> nearest;
  const auto depth = [camera = view()](const Pointed& at) { return project(camera, at.point).depth; };
  for (const ScanEntry& entry : workbench_.document().scans) {
    if (!entry.visible || !entry.scan) continue;
    const std::optional<std::uint32_t> point =
        pick_point(*entry.scan, view(), pointer(), pick_window * platform_.scale());
    if (!point) continue;
    const Pointed at{entry.id, *point, entry.scan->point(*point)};
    if (!nearest || depth(at) < depth(*nearest)) nearest = at;
  }
  return nearest;
}

void App::select_surface() {
  const std::optional<Pointed> pointed = point_under_pointer();
  if (!pointed) return toast("There is no point under the pointer.", false);
  Stroke stroke;
  stroke.mode = mode_of(modifiers(), state_.mode);
  stroke.surface_at = pointed->point;
  stroke.scan = pointed->scan;
  workbench_.select(stroke);
}

// The second click ends a distance, the third begins another one.
void App::measure() {
  const std::optional<Pointed> pointed = point_under_pointer();
  if (!pointed) return toast("There is no point under the pointer.", false);
  if (measured_.size() == 2) measured_.clear();
  const ScanEntry& scan = *find_scan(workbench_.document(), pointed->scan);
  measured_.push_back({pointed->scan, pointed->point, point_covariance(scan, pointed->id)});
}

void App::click() {
  if (const std::optional<std::string> patch = pick_patch(workbench_.document(), view(), pointer()))
    select(*patch);
}

void App::lasso(LassoTool::Outcome outcome) {
  const Stroke stroke{lasso_.mode(), lasso_.contour(view()), view(), state_.visible_only};
  switch (outcome) {
    case LassoTool::Outcome::none:
      return;
    case LassoTool::Outcome::changed:
      if (stroke.polygon.size() >= 3) workbench_.preview(stroke);
      return;
    case LassoTool::Outcome::closed:
      workbench_.select(stroke);
      lasso_.reset();
      return;
    case LassoTool::Outcome::cancelled:
      workbench_.drop_preview();
      return;
  }
}

}  // namespace patchlab::viewer
