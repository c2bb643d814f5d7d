#include <string>

#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

struct ToolButton {
  Action action;
  const char* text;
  const char* key;  // shown beside it; the modifier of a mode
};
constexpr ToolButton kTools[] = {{Action::orbit_tool, "Orbit", "O"},
                                 {Action::lasso_tool, "Lasso", "L"},
                                 {Action::rectangle_tool, "Rect", "M"},
                                 {Action::surface_tool, "Surface", "G"},
                                 {Action::measure_tool, "Measure", "D"}};
constexpr ToolButton kModes[] = {{Action::mode_set, "Set", ""},
                                 {Action::mode_add, "Add", "Shift"},
                                 {Action::mode_subtract, "Sub", "Ctrl"},
                                 {Action::mode_intersect, "Int", "both"}};
constexpr ToolButton kBasis[] = {{Action::visible_only, "Visible only", "X"}};
constexpr ToolButton kSurfaces[] = {{Action::fit_automatic, "Auto", "0"},
                                    {Action::fit_paraboloid, "Paraboloid", "1"},
                                    {Action::fit_plane, "Plane", "2"},
                                    {Action::fit_sphere, "Sphere", "3"},
                                    {Action::fit_cylinder, "Cylinder", "4"}};
constexpr ToolButton kRobust[] = {{Action::robust, "Reject outliers", "R"}};

SelectMode mode_shown(const ViewState& state) { return state.drawing ? state.contour_mode : state.mode; }

template <std::size_t n>
float group_width(const Gui& gui, const ToolButton (&tools)[n], bool keys) {
  float width = gui.px(24);
  for (const ToolButton& tool : tools)
    width += button_width(gui, tool.text, keys ? tool.key : "") + gui.px(4);
  return width;
}

template <std::size_t n>
void draw_group(const PanelInput& in, const ToolButton (&tools)[n], bool keys, Requests& out) {
  ViewState shown = in.state;
  shown.mode = mode_shown(in.state);
  for (const ToolButton& tool : tools) {
    const ActionRow& action = row(tool.action);
    const std::string name = std::string("tools/") + tool.text;
    const bool chosen = is_chosen(tool.action, shown).value_or(false);
    if (button(in.gui, name.c_str(), tool.text, {.key = keys ? tool.key : "", .chosen = chosen})) {
      out.actions.push_back(tool.action);
    }
    const std::string key = key_name(action);
    tooltip(in.gui,
            std::string(action.name) + (key.empty() ? "" : " (" + key + ")") + ": " + action.help + ".");
    ImGui::SameLine(0, in.gui.px(4));
  }
}

void draw_divider(const Gui& gui) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine({at.x + gui.px(8), at.y + gui.px(4)},
                                      {at.x + gui.px(8), at.y + gui.px(24)}, u32(gui.theme.line), gui.px(1));
  ImGui::SetCursorScreenPos({at.x + gui.px(20), at.y});
}

}  // namespace

void draw_tool_bar(const PanelInput& in, Requests& out) {
  const Gui& gui = in.gui;
  begin_panel("tools", in.layout.tools, gui.theme.bar, {gui.px(12), gui.px(8)});
  const float needed = group_width(gui, kTools, true) + group_width(gui, kModes, true) +
                       group_width(gui, kBasis, true) + group_width(gui, kSurfaces, true) +
                       group_width(gui, kRobust, true);
  const bool keys = needed <= in.layout.tools.width;
  draw_group(in, kTools, keys, out);
  draw_divider(gui);
  draw_group(in, kModes, keys, out);
  draw_divider(gui);
  draw_group(in, kBasis, keys, out);
  draw_divider(gui);
  draw_group(in, kSurfaces, keys, out);
  draw_divider(gui);
  draw_group(in, kRobust, keys, out);
  end_panel();
}

}  // namespace patchlab::viewer
