#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <optional>

#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

enum class Glyph { dot, diamond, cloud, square };

struct Row {
  std::string id, name, remark;
  Glyph glyph;
  Rgba colour;
  bool visible = true;
  bool draft = false;
  bool part = false;  // of what stands above it: neither hidden nor renamed by itself
};

void draw_glyph(const Gui& gui, ImVec2 centre, const Row& row) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 colour = u32(row.colour);
  const float r = gui.px(5);
  const float line = gui.px(1.5f);
  switch (row.glyph) {
    case Glyph::dot:
      if (row.visible)
        draw.AddCircleFilled(centre, r, colour, 20);
      else
        draw.AddCircle(centre, r, colour, 20, line);
      break;
    case Glyph::diamond: {
      const ImVec2 top = {centre.x, centre.y - r - 1}, right = {centre.x + r + 1, centre.y};
      const ImVec2 bottom = {centre.x, centre.y + r + 1}, left = {centre.x - r - 1, centre.y};
      if (row.visible && !row.draft)
        draw.AddQuadFilled(top, right, bottom, left, colour);
      else
        draw.AddQuad(top, right, bottom, left, colour, line);
      break;
    }
    case Glyph::square:
      if (row.visible)
        draw.AddRectFilled({centre.x - r, centre.y - r}, {centre.x + r, centre.y + r}, colour, gui.px(2));
      else
        draw.AddRect({centre.x - r, centre.y - r}, {centre.x + r, centre.y + r}, colour, gui.px(2), 0, line);
      break;
    case Glyph::cloud:
      for (const ImVec2 offset :
           {ImVec2{-4, 3}, ImVec2{0, -3}, ImVec2{4, 2}, ImVec2{0, 4}, ImVec2{-3, -1}, ImVec2{3, -3}}) {
        draw.AddCircleFilled({centre.x + gui.px(offset.x), centre.y + gui.px(offset.y)},
                             row.visible ? gui.px(1.6f) : gui.px(0.8f), colour, 8);
      }
  }
}

void draw_name_field(const PanelInput& in, const Row& row, float width, PanelMemory& memory, Requests& out) {
  ImGui::SetNextItemWidth(width);
  ImGui::SetKeyboardFocusHere();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {in.gui.px(4), in.gui.px(3)});
  const bool entered = ImGui::InputText(
      "##name", &memory.new_name, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  ImGui::PopStyleVar();
  in.gui.note("tree/name");
  if (entered && !memory.new_name.empty() && memory.new_name != row.name) {
    out.commands.push_back(Rename{row.id, memory.new_name});
  }
  if (entered || ImGui::IsItemDeactivated()) memory.renaming.clear();
}

// Colours to choose from, for regions and patches.
void draw_colour_choice(const PanelInput& in, const Row& row, Requests& out) {
  const Gui& gui = in.gui;
  std::optional<SetColour> wanted;
  for (std::size_t i = 0; i < okabe_ito.size(); ++i) {
    if (i > 0) ImGui::SameLine(0.0f, gui.px(4));
    const Rgba colour = rgba(okabe_ito[i]);
    const ImVec4 shown(colour[0], colour[1], colour[2], 1.0f);
    ImGui::PushID(static_cast<int>(i));
    constexpr auto plain = ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop;
    if (ImGui::ColorButton("colour", shown, plain, {gui.px(18), gui.px(18)}))
      wanted = SetColour{row.id, okabe_ito[i]};
    gui.note("tree/colour " + std::to_string(i + 1));
    ImGui::PopID();
  }
  if (wanted) {
    out.commands.push_back(*wanted);
    ImGui::CloseCurrentPopup();
  }
  if (ImGui::MenuItem("Automatic colour")) out.commands.push_back(SetColour{row.id, std::nullopt});
}

void draw_row_menu(const PanelInput& in, const Row& row, PanelMemory& memory, Requests& out) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {in.gui.px(10), in.gui.px(8)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {in.gui.px(8), in.gui.px(6)});
  if (ImGui::BeginPopupContextItem("row menu")) {
    out.select = row.id;
    const bool changes = !row.draft && !row.part;
    if (ImGui::MenuItem("Rename", "F2", false, changes)) {
      memory.renaming = row.id;
      memory.new_name = row.name;
    }
    if (ImGui::MenuItem(row.visible ? "Hide" : "Show", nullptr, false, changes)) {
      out.commands.push_back(Show{row.id, !row.visible});
    }
    if (ImGui::MenuItem("Frame", "F")) out.actions.push_back(Action::frame_selection);
    if (ImGui::MenuItem("Delete", "Delete", false, changes)) out.commands.push_back(Delete{row.id});
    if (changes && (row.glyph == Glyph::dot || row.glyph == Glyph::diamond)) {
      ImGui::Separator();
      draw_colour_choice(in, row, out);
    }
    close_on_escape();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

void draw_row(const PanelInput& in, const Row& row, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  const Theme& theme = gui.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(26);
  ImGui::PushID(row.id.c_str());
  ImGui::InvisibleButton("row", {width, height});
  gui.note("tree/" + row.name);
  const bool hovered = ImGui::IsItemHovered();
  const bool chosen = in.state.selected == row.id;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (chosen || hovered) {
    draw.AddRectFilled(at, {at.x + width, at.y + height}, u32(chosen ? theme.accent_ground : theme.hover),
                       gui.px(5));
  }
  const float indent = row.part ? gui.px(14) : 0.0f, text_x = at.x + gui.px(30) + indent;
  const bool on_glyph = hovered && !row.part && ImGui::GetIO().MousePos.x < text_x;
  if (ImGui::IsItemClicked(ImGuiMouseButton_Left)) {
    if (on_glyph && !row.draft)
      out.commands.push_back(Show{row.id, !row.visible});
    else
      out.select = row.id;
  }
  if (hovered && !on_glyph && !row.draft && !row.part && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    memory.renaming = row.id;
    memory.new_name = row.name;
  }
  if (on_glyph) tooltip(gui, row.visible ? "Hide" : "Show");
  draw_row_menu(in, row, memory, out);
  draw_glyph(gui, {at.x + gui.px(17) + indent, at.y + height / 2}, row);
  if (memory.renaming == row.id) {
    ImGui::SetCursorScreenPos({text_x - gui.px(4), at.y + gui.px(1)});
    draw_name_field(in, row, width - (text_x - at.x), memory, out);
  } else {
    const float remark_width = text_size(gui.fonts.small, row.remark).x;
    const float remark_y = at.y + (height - gui.fonts.small->FontSize) / 2 + gui.px(0.5f);
    draw_text_right(draw, gui.fonts.small, {at.x + width - gui.px(10), remark_y}, theme.text_dim, row.remark);
    const std::string shown = fit_text(gui.fonts.body, row.name, width - gui.px(52) - indent - remark_width);
    draw_text(draw, gui.fonts.body, {text_x, at.y + (height - gui.fonts.body->FontSize) / 2},
              row.visible ? (row.draft ? theme.accent_text : theme.text) : theme.text_dim, shown);
  }
  ImGui::SetCursorScreenPos({at.x, at.y + height});
  ImGui::PopID();
}

void draw_rows(const PanelInput& in, const char* title, const std::vector<Row>& rows, PanelMemory& memory,
               Requests& out) {
  if (rows.empty()) return;
  ImGui::Indent(in.gui.px(10));
  section(in.gui, title);
  ImGui::Unindent(in.gui.px(10));
  for (const Row& row : rows) draw_row(in, row, memory, out);
}

void draw_history(const PanelInput& in, Requests& out) {
  if (in.state.history.empty()) return;
  const Gui& gui = in.gui;
  ImGui::Indent(gui.px(10));
  section(gui, "HISTORY");
  ImGui::Unindent(gui.px(10));
  for (std::size_t i = 0; i < in.state.history.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = gui.px(21);
    if (ImGui::InvisibleButton("step", {width, height})) out.history_position = i + 1;
    gui.note("history/" + std::to_string(i + 1));
    const bool stands = i < in.state.position, last = i + 1 == in.state.position;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) {
      draw.AddRectFilled(from, {from.x + width, from.y + height}, u32(gui.theme.hover), gui.px(5));
      tooltip(gui, in.state.history[i] + (last     ? ""
                                          : stands ? "\nGo back to this step."
                                                   : "\nDo again up to this step."));
    }
    Rgba colour = stands ? gui.theme.text_dim : with_alpha(gui.theme.text_dim, 0.45f);
    if (last) colour = gui.theme.text;
    draw_text(draw, gui.fonts.body, {from.x + gui.px(10), from.y + (height - gui.fonts.body->FontSize) / 2},
              colour, fit_text(gui.fonts.body, in.state.history[i], width - gui.px(20)));
    ImGui::SetCursorScreenPos({from.x, from.y + height});
    ImGui::PopID();
  }
  ImGui::Dummy({1, gui.px(8)});
}

std::vector<Row> scan_rows(const PanelInput& in) {
  std::vector<Row> rows;
  for (const ScanEntry& entry : in.document.scans) {
    const std::string points = entry.scan ? short_count(entry.scan->size()) : "";
    rows.push_back({entry.id, entry.name, points, Glyph::cloud, in.gui.theme.text_dim, entry.visible});
  }
  return rows;
}

std::vector<Row> region_rows(const PanelInput& in) {
  std::vector<Row> rows;
  for (const RegionEntry& entry : in.document.regions) {
    rows.push_back({entry.id, entry.name, count(entry.points ? entry.points->size() : 0), Glyph::dot,
                    colour_of(entry), entry.visible});
  }
  return rows;
}

std::vector<Row> patch_rows(const PanelInput& in) {
  std::vector<Row> rows;
  for (const PatchEntry& entry : in.document.patches) {
    const bool draft = entry.id == in.state.draft;
    rows.push_back({entry.id, entry.name,
                    draft       ? "not kept"
                    : entry.fit ? short_surface_words(entry.fit->patch.type->surface)
                                : "",
                    Glyph::diamond, colour_of(entry), entry.visible, draft});
  }
  return rows;
}

// Each with the patches of its own below it.
std::vector<Row> map_rows(const PanelInput& in, const std::vector<PlacedPatch>& placed) {
  std::vector<Row> rows;
  const auto add_patches = [&](const std::string& owner, const Rgba& colour, bool visible) {
    for (const PlacedPatch& patch : placed) {
      if (patch.owner != owner || patch.of == PatchOf::scan) continue;
      rows.push_back({patch.id, patch.name, short_surface_words(patch.patch.type->surface), Glyph::diamond,
                      colour, visible, false, true});
    }
  };
  for (const MapEntry& entry : in.document.maps) {
    const Rgba& colour = in.gui.theme.map_patch;
    rows.push_back(
        {entry.id, entry.name, count(entry.map->patches.size()), Glyph::square, colour, entry.visible});
    add_patches(entry.id, colour, entry.visible);
  }
  for (const RobotEntry& entry : in.document.robots) {
    const Rgba& colour = in.gui.theme.robot_patch;
    rows.push_back({entry.id, entry.name, "robot", Glyph::square, colour, entry.visible});
    add_patches(entry.id, colour, entry.visible);
  }
  return rows;
}

}  // namespace

void draw_tree(const PanelInput& in, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  begin_panel("tree", in.layout.tree, gui.theme.panel, {gui.px(6), gui.px(6)}, true);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), gui.px(2)});
  draw_rows(in, "SCANS", scan_rows(in), memory, out);
  draw_rows(in, "REGIONS", region_rows(in), memory, out);
  draw_rows(in, "PATCHES", patch_rows(in), memory, out);
  draw_rows(in, "MAPS AND ROBOTS", map_rows(in, placed_patches(in.document)), memory, out);
  draw_history(in, out);
  ImGui::PopStyleVar();
  end_panel();
}

}  // namespace patchlab::viewer
