// The noise model of a scan, and what else to try: the list stays open while the fits follow.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <vector>

#include "engine/sensor/noise_presets.h"
#include "viewer/panel/colours.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

struct NoiseRow {
  std::string name, specification, help;
  bool chosen = false;
};

std::vector<NoiseRow> noise_rows(const ScanEntry& scan) {
  const NoiseModel& now = scan.noise;
  std::vector<NoiseRow> rows = {{"as assumed for this scan", "", "where none is named", now.assumed}};
  const auto add = [&](std::string_view name, std::string_view specification, std::string_view help) {
    const bool chosen = !now.assumed && now.specification == specification;
    rows.push_back({std::string(name), std::string(specification), std::string(help), chosen});
  };
  if (!scan.scan->covariances.empty()) add("from file", "from_file", "the covariances that the scan holds");
  for (const NoisePreset& preset : noise_presets()) add(preset.name, preset.name, preset.camera);
  add("isotropic, 1 mm", "isotropic:0.001", "alike in all directions");
  add("isotropic, 5 mm", "isotropic:0.005", "alike in all directions");
  add("lidar, 20 mm", "lidar:range=0.02,angle=0.00087", "20 mm along the ray, 0.05° across");
  return rows;
}

void draw_noise_row(const Gui& gui, const NoiseRow& row, const std::string& scan, Requests& out) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(25);
  if (ImGui::InvisibleButton(row.name.c_str(), {width, height}))
    out.noise = SetNoise{scan, row.specification};
  gui.note("noise/" + row.name);
  tooltip(gui, row.help);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (row.chosen || ImGui::IsItemHovered()) {
    draw.AddRectFilled(at, {at.x + width, at.y + height},
                       u32(row.chosen ? gui.theme.accent_ground : gui.theme.hover), gui.px(5));
  }
  const float left = at.x + gui.px(8), y = at.y + (height - gui.fonts.body->FontSize) / 2;
  draw_text(draw, gui.fonts.body, {left, y}, row.chosen ? gui.theme.accent_text : gui.theme.text, row.name);
  const float room = width - text_size(gui.fonts.body, row.name).x - gui.px(36);
  draw_text_right(draw, gui.fonts.small, {at.x + width - gui.px(8), y + gui.px(1)}, gui.theme.text_dim,
                  fit_text(gui.fonts.small, row.help, room));
}

void draw_noise_list(const Gui& gui, const ScanEntry& scan, PanelMemory& memory, Requests& out) {
  paragraph(gui, gui.theme.text_dim,
            "What if the noise were another? All patches of the scan are fitted again.");
  ImGui::Dummy({0, gui.px(2)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), 0});
  for (const NoiseRow& row : noise_rows(scan)) draw_noise_row(gui, row, scan.id, out);
  ImGui::PopStyleVar();
  ImGui::Dummy({0, gui.px(2)});
  ImGui::SetNextItemWidth(-1);
  const bool entered =
      ImGui::InputTextWithHint("##specification", "or written out: isotropic:0.002, then Enter",
                               &memory.noise_specification, ImGuiInputTextFlags_EnterReturnsTrue);
  gui.note("noise/specification");
  if (entered && !memory.noise_specification.empty())
    out.noise = SetNoise{scan.id, memory.noise_specification};
}

}  // namespace

void draw_noise(const Gui& gui, const ScanEntry& scan, PanelMemory& memory, Requests& out) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const std::string key = key_name(row(Action::noise));
  const std::string words = fit_text(gui.fonts.body, noise_words(scan.noise), width * 0.7f);
  draw_text(*ImGui::GetWindowDrawList(), gui.fonts.body, {at.x, at.y + gui.px(6)}, gui.theme.text_dim,
            "noise");
  ImGui::SetCursorScreenPos({at.x + width - button_width(gui, words, key), at.y});
  const bool pressed = button(gui, "inspector/noise", words, {.key = key});
  tooltip(gui, "How far measured points lie from the truth. Another model changes every number below.");
  const ImVec2 below = {ImGui::GetItemRectMax().x, ImGui::GetItemRectMax().y + gui.px(4)};
  if (pressed || memory.choose_noise) ImGui::OpenPopup("noise models");
  memory.choose_noise = false;
  ImGui::SetNextWindowPos(below, ImGuiCond_Always, {1.0f, 0.0f});
  ImGui::SetNextWindowSize({width + gui.px(4), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gui.px(12), gui.px(10)});
  if (ImGui::BeginPopup("noise models")) {
    draw_noise_list(gui, scan, memory, out);
    close_on_escape();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
}

}  // namespace patchlab::viewer
