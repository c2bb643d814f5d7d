#include "viewer/panel/theme.h"

#include <imgui.h>

#include "viewer/panel/colours.h"

namespace patchlab::viewer {

namespace {

Theme dark() {
  return {
      .view_top = rgb(0x23272F),
      .view_bottom = rgb(0x12151B),
      .bar = rgb(0x20242C),
      .panel = rgb(0x191C23),
      .popup = rgb(0x262B35),
      .line = rgb(0x2E343F),
      .hover = rgb(0x2A303B),
      .pressed = rgb(0x343C49),
      .text = rgb(0xE8EBEF),
      .text_dim = rgb(0x9BA5B2),
      .accent = rgb(0x56B4E9),
      .accent_ground = rgb(0x1F3A4D),
      .accent_text = rgb(0x8FD0F5),
      .good = rgb(0x1F9E76),
      .good_ground = rgb(0x17352D),
      .good_text = rgb(0x7FDDB8),
      .doubt = rgb(0xE69F00),
      .doubt_ground = rgb(0x3A2E14),
      .doubt_text = rgb(0xF5C25B),
      .bad = rgb(0xD55E00),
      .bad_ground = rgb(0x40241A),
      .bad_text = rgb(0xFF9D6E),
      .point_lit = rgb(0xC3C9D2),
      .point_dark = rgb(0x3F4650),
      .point_selected = rgb(0xFFE9B0),
      .point_outlier = rgb(0xFF6A13),
      .axis_x = rgb(0xFF6B5E),
      .axis_y = rgb(0x7BD672),
      .axis_z = rgb(0x5AA9FF),
      .ellipsoid = rgb(0x7CC7F2, 0.45f),
      .ellipsoid_rim = rgb(0xC4E7FB),
      .map_patch = rgb(0x4FAF6E),
      .robot_patch = rgb(0xB9783F),
      .robot_link = rgb(0xA7AEB9),
      .gaussian = rgb(0x3D8BF0, 0.85f),
      .neutral_lightness = 0.32,
  };
}

Theme light() {
  return {
      .view_top = rgb(0xFFFFFF),
      .view_bottom = rgb(0xE6EAF0),
      .bar = rgb(0xE9ECF1),
      .panel = rgb(0xF5F6F9),
      .popup = rgb(0xFFFFFF),
      .line = rgb(0xD5DAE2),
      .hover = rgb(0xE3E8EF),
      .pressed = rgb(0xD3DAE4),
      .text = rgb(0x1A1F28),
      .text_dim = rgb(0x535E6D),
      .accent = rgb(0x0072B2),
      .accent_ground = rgb(0xD5E9F6),
      .accent_text = rgb(0x005B8F),
      .good = rgb(0x00875F),
      .good_ground = rgb(0xDCF1E9),
      .good_text = rgb(0x00654A),
      .doubt = rgb(0xB97700),
      .doubt_ground = rgb(0xFBEFD6),
      .doubt_text = rgb(0x7A4F00),
      .bad = rgb(0xC14E00),
      .bad_ground = rgb(0xFBE5DA),
      .bad_text = rgb(0x963800),
      .point_lit = rgb(0xA3ACB9),
      .point_dark = rgb(0x39414D),
      .point_selected = rgb(0xB36B00),
      .point_outlier = rgb(0xE04A00),
      .axis_x = rgb(0xC93428),
      .axis_y = rgb(0x2C8A2E),
      .axis_z = rgb(0x1F63C9),
      .ellipsoid = rgb(0x2E86BE, 0.40f),
      .ellipsoid_rim = rgb(0x0B4F7A),
      .map_patch = rgb(0x3C9A5F),
      .robot_patch = rgb(0xA0622D),
      .robot_link = rgb(0xC9CED6),
      .gaussian = rgb(0x2266CC, 0.85f),
      .neutral_lightness = 0.90,
  };
}

ImVec4 vec(const Rgba& c) { return {c[0], c[1], c[2], c[3]}; }

void set_colours(ImGuiStyle& style, const Theme& theme) {
  const Rgba clear = with_alpha(theme.panel, 0.0f);
  const struct {
    ImGuiCol_ slot;
    Rgba colour;
  } table[] = {
      {ImGuiCol_Text, theme.text},
      {ImGuiCol_TextDisabled, theme.text_dim},
      {ImGuiCol_WindowBg, theme.panel},
      {ImGuiCol_ChildBg, clear},
      {ImGuiCol_PopupBg, theme.popup},
      {ImGuiCol_Border, theme.line},
      {ImGuiCol_FrameBg, theme.hover},
      {ImGuiCol_FrameBgHovered, theme.hover},
      {ImGuiCol_FrameBgActive, theme.hover},
      {ImGuiCol_MenuBarBg, theme.bar},
      {ImGuiCol_ScrollbarBg, clear},
      {ImGuiCol_ScrollbarGrab, theme.pressed},
      {ImGuiCol_ScrollbarGrabHovered, theme.text_dim},
      {ImGuiCol_ScrollbarGrabActive, theme.text_dim},
      {ImGuiCol_CheckMark, theme.accent},
      {ImGuiCol_Button, theme.hover},
      {ImGuiCol_ButtonHovered, theme.pressed},
      {ImGuiCol_ButtonActive, theme.accent_ground},
      {ImGuiCol_Header, theme.accent_ground},
      {ImGuiCol_HeaderHovered, theme.hover},
      {ImGuiCol_HeaderActive, theme.pressed},
      {ImGuiCol_Separator, theme.line},
      {ImGuiCol_TextSelectedBg, theme.accent_ground},
      {ImGuiCol_NavHighlight, theme.accent},
      {ImGuiCol_ModalWindowDimBg, with_alpha(theme.view_bottom, 0.55f)},
      {ImGuiCol_TitleBg, theme.popup},
      {ImGuiCol_TitleBgActive, theme.popup},
  };
  for (const auto& [slot, colour] : table) style.Colors[slot] = vec(colour);
}

}  // namespace

Theme theme(ThemeChoice choice) { return choice == ThemeChoice::dark ? dark() : light(); }

void apply_style(const Theme& theme, float scale) {
  ImGuiStyle style;
  style.WindowPadding = {14, 12};
  style.FramePadding = {8, 5};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.WindowRounding = style.ChildRounding = 0;
  style.PopupRounding = 8;
  style.FrameRounding = 5;
  style.GrabRounding = style.ScrollbarRounding = 4;
  style.WindowBorderSize = style.ChildBorderSize = style.FrameBorderSize = 0;
  style.PopupBorderSize = 1;
  style.ScrollbarSize = 8;
  style.WindowTitleAlign = {0, 0.5f};
  set_colours(style, theme);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace patchlab::viewer
