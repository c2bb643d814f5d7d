// The edges of the side panels: dragged, they make the panels wider or narrower.
#include <imgui.h>

#include <algorithm>

#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

constexpr float splitter_reach = 3.0f;                // px each side of an edge
constexpr float narrowest = 160.0f, widest = 720.0f;  // px at scale 1

// Returns how far the edge is dragged, px at scale 1.
float draw_splitter(const PanelInput& in, const char* name, float x) {
  const Gui& gui = in.gui;
  const Rect& view = in.layout.view;
  begin_panel(name, {x - gui.px(splitter_reach), view.y, gui.px(2 * splitter_reach), view.height},
              with_alpha(gui.theme.line, 0.0f), {0, 0});
  ImGui::InvisibleButton(name, {gui.px(2 * splitter_reach), view.height});
  gui.note(name);
  const bool held = ImGui::IsItemActive();
  if (held || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddLine({x, view.y}, {x, view.bottom()}, u32(gui.theme.accent), gui.px(2));
  }
  end_panel();
  return held ? ImGui::GetIO().MouseDelta.x / gui.scale : 0.0f;
}

}  // namespace

void draw_splitters(const PanelInput& in, Requests& out) {
  if (!in.state.side_panels) return;
  const float tree = draw_splitter(in, "splitter/tree", in.layout.view.x);
  const float inspector = draw_splitter(in, "splitter/inspector", in.layout.view.right());
  if (tree == 0.0f && inspector == 0.0f) return;
  PanelWidths widths = in.state.widths;
  widths.tree = std::clamp(widths.tree + tree, narrowest, widest);
  widths.inspector = std::clamp(widths.inspector - inspector, narrowest, widest);
  out.widths = widths;
}

}  // namespace patchlab::viewer
