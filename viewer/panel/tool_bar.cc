#include <span>
#include <string>
#include <utility>

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

// Where there is too little room for all, the less important ones are in the menus alone.
struct Group {
  std::span<const ToolButton> tools;
  int importance;
};
constexpr Group kGroups[] = {{kTools, 4}, {kModes, 1}, {kBasis, 2}, {kSurfaces, 3}, {kRobust, 0}};

float width_of(const Gui& gui, int least_importance, bool keys) {
  float width = 0;
  for (const Group& group : kGroups) {
    if (group.importance < least_importance) continue;
    width += gui.px(24);
    for (const ToolButton& tool : group.tools)
      width += button_width(gui, tool.text, keys ? tool.key : "") + gui.px(4);
  }
  return width;
}

void draw_group(const PanelInput& in, std::span<const ToolButton> tools, bool keys, Requests& out) {
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
  const float room = in.layout.tools.width - gui.px(12);
  const bool keys = width_of(gui, 0, true) <= room;
  int least_importance = 0;
  while (least_importance < kGroups[0].importance && !keys && width_of(gui, least_importance, false) > room)
    ++least_importance;
  bool first = true;
  for (const Group& group : kGroups) {
    if (group.importance < least_importance) continue;
    if (!std::exchange(first, false)) draw_divider(gui);
    draw_group(in, group.tools, keys, out);
  }
  end_panel();
}

}  // namespace patchlab::viewer
