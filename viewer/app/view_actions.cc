// What the user asks of the view: where it looks from, how large things are, how they look.
#include <algorithm>
#include <numbers>

#include "viewer/app/app.h"

namespace patchlab::viewer {

namespace {

constexpr float least_scale = 0.5f, largest_scale = 4.0f, scale_step = 1.1f;
constexpr float least_point = 1.0f, largest_point = 12.0f, point_step = 0.5f;

}  // namespace

bool App::act_on_view(Action action) {
  const Document& document = workbench_.document();
  const auto point_size = [this](float step) {
    state_.point_size = std::clamp(state_.point_size + step, least_point, largest_point);
  };
  switch (action) {
    case Action::home:
      stage_.frame_all(document, aspect());
      return true;
    case Action::frame_selection:
      stage_.frame(document, state_.selected, aspect());
      return true;
    case Action::sensor_view:
      view_of_sensor();
      return true;
    case Action::perspective:
      stage_.camera.perspective = state_.perspective = !state_.perspective;
      return true;
    case Action::larger_points:
      point_size(point_step);
      return true;
    case Action::smaller_points:
      point_size(-point_step);
      return true;
    case Action::cividis:
      state_.map = state_.map == ColourMap::viridis ? ColourMap::cividis : ColourMap::viridis;
      return true;
    case Action::side_panels:
      state_.side_panels = !state_.side_panels;
      return true;
    case Action::theme:
      state_.theme = state_.theme == ThemeChoice::dark ? ThemeChoice::light : ThemeChoice::dark;
      return true;
    case Action::larger_interface:
      scale_interface(platform_.scale() * scale_step);
      return true;
    case Action::smaller_interface:
      scale_interface(platform_.scale() / scale_step);
      return true;
    case Action::normal_interface:
      scale_interface(1.0f);
      return true;
    default:
      return false;
  }
}

bool App::turn_view(Action action) {
  constexpr double quarter = std::numbers::pi / 2;
  constexpr struct {
    Action action;
    double azimuth, elevation;
  } views[] = {{Action::view_front, 0, 0},          {Action::view_right, quarter, 0},
               {Action::view_back, 2 * quarter, 0}, {Action::view_left, -quarter, 0},
               {Action::view_top, 0, quarter},      {Action::view_below, 0, -quarter},
               {Action::view_oblique, 0.6, 0.5}};
  for (const auto& view : views) {
    if (view.action != action) continue;
    stage_.look_from(view.azimuth, view.elevation);
    return true;
  }
  return false;
}

void App::view_of_sensor() {
  const std::vector<ScanEntry>& scans = workbench_.document().scans;
  if (!scans.empty() && scans.back().scan) stage_.view_of_sensor(*scans.back().scan, aspect());
}

void App::scale_interface(float scale) {
  wanted_scale_ = chosen_scale_ = std::clamp(scale, least_scale, largest_scale);
}

}  // namespace patchlab::viewer
