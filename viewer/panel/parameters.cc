#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"
#include "viewer/panel/parameter_rows.h"

namespace patchlab::viewer {

namespace {

constexpr double well_known = 0.01, poorly_known = 0.05;  // shares where the bar changes its colour

Rgba bar_colour(const Theme& theme, double share) {
  return share < well_known ? theme.good : share < poorly_known ? theme.doubt : theme.bad;
}

void draw_row(const Gui& gui, const ParameterRow& parameter) {
  const Theme& theme = gui.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_label(gui, draw, at, theme.text_dim, parameter.name);
  draw_text_right(draw, gui.fonts.body, {at.x + width * 0.62f, at.y}, theme.text, parameter.value);
  draw_text_right(draw, gui.fonts.body, {at.x + width, at.y}, theme.text, parameter.sigma);
  const float bar_y = at.y + gui.fonts.body->FontSize + gui.px(2), bar = gui.px(3);
  draw.AddRectFilled({at.x, bar_y}, {at.x + width, bar_y + bar}, u32(theme.line), bar / 2);
  const float filled = width * static_cast<float>(bar_length(parameter.share));
  if (!parameter.sigma.empty() && filled > bar) {
    draw.AddRectFilled({at.x, bar_y}, {at.x + filled, bar_y + bar}, u32(bar_colour(theme, parameter.share)),
                       bar / 2);
  }
  ImGui::Dummy({width, gui.fonts.body->FontSize + gui.px(6)});
  if (!parameter.sigma.empty()) {
    tooltip(gui, "The standard deviation is " + significant(parameter.share * 100.0, 2) + " % " +
                     parameter.of + ". The bar is logarithmic: from 0.01 % to 100 %.");
  }
}

std::string centre_text(const Eigen::Vector3d& c) {
  return fixed(c.x(), 3) + ",  " + fixed(c.y(), 3) + ",  " + fixed(c.z(), 3) + " m";
}

}  // namespace

void draw_parameters(const Gui& gui, const Patch& patch) {
  section(gui, "PARAMETERS", patch.covariance_local ? "σ, and how large a share it is" : "no covariance");
  for (const ParameterRow& parameter : parameter_rows(patch)) draw_row(gui, parameter);
  fact(gui, "centre", centre_text(centre(patch)));
}

}  // namespace patchlab::viewer
