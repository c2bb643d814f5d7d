#include "viewer/panel/gui.h"

#include <algorithm>
#include <cmath>

#include "viewer/panel/colours.h"
#include "viewer/platform/key.h"

namespace patchlab::viewer {

namespace {

// ImGui takes an end of nullptr, as an empty view may have, for "up to the terminating zero".
ImVec2 size_of(ImFont* font, std::string_view text, float wrap_width) {
  if (text.empty()) return {0.0f, font->FontSize};
  return font->CalcTextSizeA(font->FontSize, 1e9f, wrap_width, text.data(), text.data() + text.size());
}

// A label before, in and after its subscript, which is the one character after "_".
struct Label {
  std::string_view stem, subscript, tail;
};

Label split_label(std::string_view text) {
  const std::size_t at = text.find('_');
  if (at == std::string_view::npos || at + 1 == text.size()) return {text, {}, {}};
  return {text.substr(0, at), text.substr(at + 1, 1), text.substr(at + 2)};
}

}  // namespace

void Gui::note(const std::string& name) const {
  if (!widgets) return;
  const ImVec2 min = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  (*widgets)[name] = {min.x, min.y, size.x, size.y};
}

ImU32 u32(const Rgba& colour) {
  return ImGui::ColorConvertFloat4ToU32({colour[0], colour[1], colour[2], colour[3]});
}

void draw_text(ImDrawList& draw, ImFont* font, ImVec2 at, const Rgba& colour, std::string_view text) {
  if (text.empty()) return;
  draw.AddText(font, font->FontSize, {std::round(at.x), std::round(at.y)}, u32(colour), text.data(),
               text.data() + text.size());
}

void draw_text_right(ImDrawList& draw, ImFont* font, ImVec2 right_at, const Rgba& colour,
                     std::string_view text) {
  draw_text(draw, font, {right_at.x - text_size(font, text).x, right_at.y}, colour, text);
}

ImVec2 text_size(ImFont* font, std::string_view text, float wrap_width) {
  return size_of(font, text, wrap_width);
}

std::string fit_path(ImFont* font, std::string_view path, float width) {
  if (text_size(font, path).x <= width) return std::string(path);
  const std::string dots = "\u2026";
  while (!path.empty() && text_size(font, dots + std::string(path)).x > width) {
    do {
      path.remove_prefix(1);
    } while (!path.empty() && (static_cast<unsigned char>(path.front()) & 0xc0) == 0x80);
  }
  return dots + std::string(path);
}

std::string fit_text(ImFont* font, std::string_view text, float width) {
  if (text_size(font, text).x <= width) return std::string(text);
  const std::string dots = "\u2026";
  while (!text.empty()) {
    do {
      text.remove_suffix(1);
    } while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80);
    if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xc0) text.remove_suffix(1);
    if (text_size(font, std::string(text) + dots).x <= width) break;
  }
  return std::string(text) + dots;
}

float draw_label(const Gui& gui, ImDrawList& draw, ImVec2 at, const Rgba& colour, std::string_view text) {
  const Label label = split_label(text);
  float x = at.x;
  draw_text(draw, gui.fonts.body, {x, at.y}, colour, label.stem);
  x += text_size(gui.fonts.body, label.stem).x;
  const float drop = gui.fonts.body->FontSize - gui.fonts.small->FontSize + gui.px(2);
  draw_text(draw, gui.fonts.small, {x, at.y + drop}, colour, label.subscript);
  x += text_size(gui.fonts.small, label.subscript).x;
  draw_text(draw, gui.fonts.body, {x, at.y}, colour, label.tail);
  return x + text_size(gui.fonts.body, label.tail).x - at.x;
}

void draw_plate(const Gui& gui, ImVec2 from, ImVec2 to, ImDrawList& draw) {
  draw.AddRectFilled(from, to, u32(with_alpha(gui.theme.panel, 0.88f)), gui.px(7));
}

void begin_panel(const char* name, const Rect& rect, const Rgba& ground, ImVec2 padding, bool scrolls) {
  ImGui::SetNextWindowPos(corner(rect));
  ImGui::SetNextWindowSize({rect.width, rect.height});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, u32(ground));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNavInputs |
                                     ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::Begin(name, nullptr, scrolls ? fixed & ~ImGuiWindowFlags_NoScrollbar : fixed);
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

void end_panel() { ImGui::End(); }

bool begin_dialog(const Gui& gui, const char* name, ImVec2 size) {
  if (!ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize(
      {std::min(gui.px(size.x), display.x * 0.9f), std::min(gui.px(size.y), display.y * 0.86f)});
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, 0, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gui.px(22), gui.px(18)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, gui.px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, gui.px(1));
  const bool open = ImGui::BeginPopupModal(name, nullptr, ImGuiWindowFlags_NoDecoration);
  ImGui::PopStyleVar(3);
  return open;
}

void end_dialog() { ImGui::EndPopup(); }

void close_on_escape() {
  if (ImGui::IsKeyPressed(key::escape, false)) ImGui::CloseCurrentPopup();
}

void section(const Gui& gui, const char* title, std::string_view remark) {
  const float above = gui.px(14);
  const ImVec2 from = ImGui::GetCursorScreenPos(), at = {from.x, from.y + above};
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_text(draw, gui.fonts.heading, at, gui.theme.text_dim, title);
  draw_text_right(draw, gui.fonts.small, {at.x + width, at.y}, gui.theme.text_dim, remark);
  ImGui::Dummy({width, above + gui.fonts.heading->FontSize + gui.px(2)});
}

void paragraph(const Gui& gui, const Rgba& colour, std::string_view text, ImFont* font) {
  if (text.empty()) text = " ";
  ImGui::PushFont(font ? font : gui.fonts.body);
  ImGui::PushStyleColor(ImGuiCol_Text, u32(colour));
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void fact(const Gui& gui, std::string_view what, std::string_view value, bool is_path) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float name_width = text_size(gui.fonts.body, what).x + gui.px(12);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_text(draw, gui.fonts.body, at, gui.theme.text_dim, what);
  const std::string shown = is_path ? fit_path(gui.fonts.body, value, width - name_width)
                                    : fit_text(gui.fonts.body, value, width - name_width);
  draw_text_right(draw, gui.fonts.body, {at.x + width, at.y}, gui.theme.text, shown);
  ImGui::Dummy({width, gui.fonts.body->FontSize});
  if (shown != value) tooltip(gui, value);
}

void tooltip(const Gui& gui, std::string_view text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gui.px(10), gui.px(7)});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(gui.px(340));
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

float button_width(const Gui& gui, std::string_view text, std::string_view key) {
  const float hint = key.empty() ? 0.0f : text_size(gui.fonts.small, key).x + gui.px(8);
  return text_size(gui.fonts.body, text).x + hint + gui.px(20);
}

bool slider(const Gui& gui, const char* name, double& part) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(22), edge = gui.px(7);
  ImGui::InvisibleButton(name, {width, height});
  gui.note(name);
  const bool held = ImGui::IsItemActive(), lit = held || ImGui::IsItemHovered();
  const float reach = width - 2 * edge, left = at.x + edge, y = at.y + height / 2;
  if (held) part = std::clamp((ImGui::GetIO().MousePos.x - left) / reach, 0.0f, 1.0f);
  const float x = left + static_cast<float>(part) * reach, line = gui.px(2),
              radius = gui.px(lit ? 7.0f : 6.0f);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({left, y - line}, {left + reach, y + line}, u32(gui.theme.pressed), line);
  draw.AddRectFilled({left, y - line}, {x, y + line}, u32(gui.theme.accent), line);
  draw.AddCircleFilled({x, y}, radius, u32(gui.theme.accent), 24);
  draw.AddCircleFilled({x, y}, radius - gui.px(2), u32(lit ? gui.theme.accent : gui.theme.panel), 24);
  return held;
}

bool button(const Gui& gui, const char* name, std::string_view text, const ButtonLook& look) {
  const Theme& theme = gui.theme;
  const ImVec2 size = {button_width(gui, text, look.key), gui.px(28)};
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::BeginDisabled(!look.enabled);
  const bool pressed = ImGui::InvisibleButton(name, size);
  ImGui::EndDisabled();
  gui.note(name);
  const bool lit = look.chosen || look.strong;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end = {at.x + size.x, at.y + size.y};
  const float rounding = gui.px(6);
  if (lit) {
    draw.AddRectFilled(at, end, u32(theme.accent_ground), rounding);
    draw.AddRect(at, end, u32(theme.accent), rounding, 0, gui.px(1));
  } else if (ImGui::IsItemHovered() && look.enabled) {
    draw.AddRectFilled(at, end, u32(ImGui::IsItemActive() ? theme.pressed : theme.hover), rounding);
  }
  Rgba colour = lit ? theme.accent_text : theme.text;
  if (!look.enabled) colour = with_alpha(theme.text_dim, 0.5f);
  const float text_y = at.y + (size.y - gui.fonts.body->FontSize) / 2;
  draw_text(draw, gui.fonts.body, {at.x + gui.px(10), text_y}, colour, text);
  const float key_y = at.y + (size.y - gui.fonts.small->FontSize) / 2 + gui.px(0.5f);
  draw_text_right(draw, gui.fonts.small, {end.x - gui.px(10), key_y}, lit ? colour : theme.text_dim,
                  look.key);
  return pressed;
}

}  // namespace patchlab::viewer
