#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

void draw_item(const PanelInput& in, const ActionRow& item, Requests& out) {
  const std::string key = key_name(item);
  const std::optional<bool> chosen = is_chosen(item.action, in.state);
  const bool enabled = is_possible(item.action, in.document, in.state);
  if (ImGui::MenuItem(item.name, key.empty() ? nullptr : key.c_str(), chosen.value_or(false), enabled)) {
    out.actions.push_back(item.action);
  }
  in.gui.note(std::string("menu/") + item.name);
  tooltip(in.gui, item.help);
}

void draw_earlier_work(const PanelInput& in, Requests& out) {
  ImGui::Separator();
  for (const EarlierWork& work : in.state.earlier) {
    const std::string name = "Go on with " + work.scan;
    ImGui::PushID(work.journal.c_str());
    if (ImGui::MenuItem(name.c_str(), work.remark.c_str())) out.open = OpenRequest{work.journal};
    ImGui::PopID();
    tooltip(in.gui, work.journal.string());
  }
}

// Items that belong together are adjacent in the table; a line parts the groups of the longer menus.
bool starts_group(Action action) {
  return action == Action::quit || action == Action::remove || action == Action::mode_set ||
         action == Action::last_vertex || action == Action::invert || action == Action::hide ||
         action == Action::fit_elliptic || action == Action::bound_automatic ||
         action == Action::visible_only || action == Action::robust || action == Action::keep ||
         action == Action::view_right || action == Action::perspective || action == Action::cividis ||
         action == Action::sigma_of_both || action == Action::side_panels ||
         action == Action::colour_shading || action == Action::larger_points ||
         action == Action::show_surface || action == Action::theme;
}

std::string scan_info(const Document& document) {
  if (document.scans.empty() && !document.robots.empty()) return document.robots.back().name;
  if (document.scans.empty() && !document.maps.empty()) return document.maps.back().name;
  if (document.scans.empty()) return "no scan";
  const ScanEntry& entry = document.scans.back();
  std::string info = entry.name;
  if (entry.scan) {
    info += "  ·  " + count(entry.scan->size()) + " points";
    if (entry.scan->finite_count != entry.scan->size())
      info += ", " + count(entry.scan->finite_count) + " finite";
  }
  return info + "  ·  noise: " + noise_words(entry.noise);
}

}  // namespace

void draw_menu_bar(const PanelInput& in, Requests& out) {
  const Gui& gui = in.gui;
  begin_panel("menu", in.layout.menu, gui.theme.panel, {gui.px(8), gui.px(4)});
  const float text_y = (in.layout.menu.height - gui.fonts.body->FontSize) / 2;
  ImGui::SetCursorPosY(text_y);
  float end = 0;
  for (const Menu menu : {Menu::file, Menu::edit, Menu::select, Menu::fit, Menu::view, Menu::help}) {
    const std::string popup = std::string("popup/") + name(menu);
    const ImVec2 at = {ImGui::GetCursorScreenPos().x, in.layout.menu.y + gui.px(2)};
    ImGui::SetCursorScreenPos(at);
    if (button(gui, (std::string("menu/") + name(menu)).c_str(), name(menu), {.chosen = false})) {
      ImGui::OpenPopup(popup.c_str());
    }
    end = ImGui::GetItemRectMax().x;
    ImGui::SetNextWindowPos({at.x, in.layout.menu.bottom()});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gui.px(10), gui.px(8)});
    if (ImGui::BeginPopup(popup.c_str())) {
      bool first = true;
      for (const ActionRow& item : action_table()) {
        if (item.menu != menu) continue;
        if (item.action == Action::quit && !in.state.earlier.empty()) draw_earlier_work(in, out);
        if (!first && starts_group(item.action)) ImGui::Separator();
        draw_item(in, item, out);
        first = false;
      }
      close_on_escape();
      ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
    ImGui::SameLine(0, gui.px(2));
  }
  const float right = in.layout.menu.right() - gui.px(14);
  const std::string info = fit_text(gui.fonts.body, scan_info(in.document), right - end - gui.px(24));
  draw_text_right(*ImGui::GetWindowDrawList(), gui.fonts.body, {right, in.layout.menu.y + text_y},
                  gui.theme.text_dim, info);
  end_panel();
}

}  // namespace patchlab::viewer
