// The command palette: everything the program can do, found by typing a part of its name.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "viewer/panel/colours.h"
#include "viewer/panel/panels.h"
#include "viewer/platform/key.h"

namespace patchlab::viewer {

namespace {

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return result;
}

// Every typed word is somewhere in what the row says of itself.
bool answers(const ActionRow& action, const std::string& typed) {
  const std::string text =
      in_lower_case(std::string(name(action.menu)) + " " + action.name + " " + action.help);
  std::string word;
  for (const char c : in_lower_case(typed) + " ") {
    if (c != ' ') {
      word += c;
    } else if (text.find(std::exchange(word, {})) == std::string::npos) {
      return false;
    }
  }
  return true;
}

std::vector<const ActionRow*> answering(const PanelInput& in, const std::string& typed) {
  std::vector<const ActionRow*> rows;
  for (const ActionRow& action : action_table()) {
    const bool possible = is_possible(action.action, in.document, in.state);
    if (possible && action.action != Action::palette && answers(action, typed)) rows.push_back(&action);
  }
  return rows;
}

bool draw_command(const Gui& gui, const ActionRow& action, bool at_cursor) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(27);
  const bool pressed = ImGui::InvisibleButton(action.name, {width, height});
  gui.note(std::string("palette/") + action.name);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (at_cursor || ImGui::IsItemHovered()) {
    draw.AddRectFilled(at, {at.x + width, at.y + height},
                       u32(at_cursor ? gui.theme.accent_ground : gui.theme.hover), gui.px(5));
  }
  if (at_cursor) ImGui::SetScrollHereY(0.5f);
  const float y = at.y + (height - gui.fonts.body->FontSize) / 2;
  draw_text(draw, gui.fonts.body, {at.x + gui.px(8), y}, gui.theme.text, action.name);
  const std::string key = key_name(action);
  const float key_width = text_size(gui.fonts.small, key).x + gui.px(16);
  draw_text_right(draw, gui.fonts.small, {at.x + width - gui.px(8), y + gui.px(1)}, gui.theme.accent_text,
                  key);
  const float name_width = std::max(text_size(gui.fonts.body, action.name).x, gui.px(200)) + gui.px(20);
  draw_text(draw, gui.fonts.body, {at.x + name_width, y}, gui.theme.text_dim,
            fit_text(gui.fonts.body, action.help, width - name_width - key_width));
  return pressed;
}

void move_cursor(std::size_t rows, std::size_t& cursor) {
  if (ImGui::IsKeyPressed(key::down)) ++cursor;
  if (ImGui::IsKeyPressed(key::up) && cursor > 0) --cursor;
  cursor = std::min(cursor, rows == 0 ? 0 : rows - 1);
}

}  // namespace

void draw_palette(const PanelInput& in, PanelMemory& memory, Requests& out) {
  if (!memory.palette) return;
  const Gui& gui = in.gui;
  if (!begin_dialog(gui, "palette", {680, 420})) return;
  const auto close = [&memory] {
    memory.palette = false;
    ImGui::CloseCurrentPopup();
  };
  if (ImGui::IsWindowAppearing()) {
    memory.palette_filter.clear();
    memory.palette_cursor = 0;
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-1);
  const std::string before = memory.palette_filter;
  const bool entered = ImGui::InputTextWithHint("##palette", "what to do: a part of its name",
                                                &memory.palette_filter, ImGuiInputTextFlags_EnterReturnsTrue);
  gui.note("palette/text");
  if (memory.palette_filter != before) memory.palette_cursor = 0;
  const std::vector<const ActionRow*> rows = answering(in, memory.palette_filter);
  move_cursor(rows.size(), memory.palette_cursor);
  std::optional<Action> chosen;
  if (entered && !rows.empty()) chosen = rows[memory.palette_cursor]->action;
  ImGui::BeginChild("commands");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), 0});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (draw_command(gui, *rows[i], i == memory.palette_cursor)) chosen = rows[i]->action;
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
  if (chosen) out.actions.push_back(*chosen);
  if (chosen || ImGui::IsKeyPressed(key::escape, false)) close();
  end_dialog();
}

}  // namespace patchlab::viewer
