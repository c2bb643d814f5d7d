// How thick the depth slab is: a strip at the lower edge of the view, while there is one.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

constexpr float thinnest = 1e-4f, thickest = 1e4f;  // m
constexpr float speed = 0.01f;                      // of the value, a pixel

bool drag(const Gui& gui, const char* name, const char* what, double& metres) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(what);
  ImGui::SameLine(0, gui.px(6));
  ImGui::SetNextItemWidth(gui.px(72));
  auto value = static_cast<float>(metres);
  const bool changed =
      ImGui::DragFloat((std::string("##") + name).c_str(), &value, std::max(speed * value, thinnest),
                       thinnest, thickest, "%.3f m", ImGuiSliderFlags_AlwaysClamp);
  gui.note(name);
  tooltip(
      gui,
      "How far it reaches from the plane of the pivot, towards the eye or away: drag to change, double-click to type.");
  ImGui::SameLine(0, gui.px(14));
  metres = changed ? static_cast<double>(value) : metres;
  return changed;
}

}  // namespace

void draw_slab(const PanelInput& in, Requests& out) {
  if (!in.state.slab) return;
  const Gui& gui = in.gui;
  const Rect& view = in.layout.view;
  const float width = std::min(gui.px(384), view.width), height = gui.px(40);
  begin_panel("slab", {view.right() - width - gui.px(14), view.bottom() - height - gui.px(14), width, height},
              gui.theme.bar, {gui.px(12), gui.px(7)});
  DepthSlab slab = *in.state.slab;
  const bool front = drag(gui, "slab/front", "Slab: front", slab.front);
  const bool back = drag(gui, "slab/back", "back", slab.back);
  if (front || back) out.slab = slab;
  if (button(gui, "slab/close", "Off", {.key = "Z"})) out.actions.push_back(Action::depth_slab);
  end_panel();
}

}  // namespace patchlab::viewer
