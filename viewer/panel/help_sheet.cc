#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "viewer/panel/colours.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return result;
}

bool matches(const std::string& filter, std::string_view text) {
  return lower(text).find(lower(filter)) != std::string::npos;
}

void draw_line(const Gui& gui, const std::string& key, const std::string& what, const std::string& help) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  paragraph(gui, gui.theme.accent_text, key);
  ImGui::TableNextColumn();
  paragraph(gui, gui.theme.text, what);
  ImGui::TableNextColumn();
  paragraph(gui, gui.theme.text_dim, help);
}

void draw_keys(const Gui& gui, const std::string& filter) {
  for (const ActionRow& action : action_table()) {
    const std::string key = key_name(action);
    if (key.empty() || !matches(filter, key + " " + action.name + " " + action.help)) continue;
    draw_line(gui, key, action.name, action.help);
  }
}

void draw_gestures(const Gui& gui, const std::string& filter) {
  for (const Gesture& gesture : gesture_table()) {
    if (matches(filter, std::string(gesture.gesture) + " " + gesture.help)) {
      draw_line(gui, gesture.gesture, "", gesture.help);
    }
  }
}

}  // namespace

void draw_help_sheet(const PanelInput& in, PanelMemory& memory) {
  if (!memory.help) return;
  const Gui& gui = in.gui;
  if (!begin_dialog(gui, "help sheet", {820, 640})) return;
  ImGui::PushFont(gui.fonts.title);
  ImGui::TextUnformatted("Keys and gestures");
  ImGui::PopFont();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::InputTextWithHint("##filter", "type to search", &memory.help_filter);
  ImGui::Dummy({0, gui.px(2)});
  if (ImGui::BeginTable("keys", 3, ImGuiTableFlags_ScrollY, {0, -gui.px(40)})) {
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, gui.px(150));
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, gui.px(180));
    ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
    draw_gestures(gui, memory.help_filter);
    draw_keys(gui, memory.help_filter);
    ImGui::EndTable();
  }
  ImGui::SetCursorPosX(ImGui::GetWindowWidth() - gui.px(22) - button_width(gui, "Close", "Esc"));
  const bool escape = ImGui::IsKeyPressed(row(Action::cancel).key, false);
  if (button(gui, "help/close", "Close", {.key = "Esc", .strong = true}) || escape) {
    memory.help = false;
    ImGui::CloseCurrentPopup();
  }
  end_dialog();
}

}  // namespace patchlab::viewer
