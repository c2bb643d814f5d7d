#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

struct Pill {
  std::string text;
  Rgba ground, frame, colour;
};

// Returns how much of the upper edge it takes.
float draw_pill(const PanelInput& in, ImDrawList& draw) {
  const Theme& theme = in.gui.theme;
  std::optional<Pill> pill;
  switch (in.state.currency) {
    case Currency::nothing:
      return 0.0f;
    case Currency::fitting:
      pill = {"fitting\u2026", theme.accent_ground, theme.accent, theme.accent_text};
      break;
    case Currency::preview:
      pill = {"preview: one point in " + std::to_string(in.state.fitted_one_in) +
                  (in.state.fit_runs ? ", fitting all\u2026" : ""),
              theme.accent_ground, theme.accent, theme.accent_text};
      break;
    case Currency::current:
      pill = {"up to date", theme.good_ground, theme.good, theme.good_text};
      break;
    case Currency::failed:
      pill = {"no patch", theme.doubt_ground, theme.doubt, theme.doubt_text};
      break;
  }
  const Gui& gui = in.gui;
  const ImVec2 size = {text_size(gui.fonts.body, pill->text).x + gui.px(32), gui.px(26)};
  const ImVec2 at = {in.layout.view.right() - size.x - gui.px(16), in.layout.view.y + gui.px(14)};
  const ImVec2 end = {at.x + size.x, at.y + size.y};
  draw.AddRectFilled(at, end, u32(pill->ground), size.y / 2);
  draw.AddRect(at, end, u32(pill->frame), size.y / 2, 0, gui.px(1));
  draw_text(draw, gui.fonts.body, {at.x + gui.px(16), at.y + (size.y - gui.fonts.body->FontSize) / 2},
            pill->colour, pill->text);
  return size.x + gui.px(16);
}

void draw_notes(const PanelInput& in, float taken, ImDrawList& draw) {
  if (in.state.notes.lines.empty()) return;
  const Gui& gui = in.gui;
  const float line_height = gui.fonts.body->FontSize + gui.px(4), pad = gui.px(10);
  const ImVec2 at = {in.layout.view.x + gui.px(14), in.layout.view.y + gui.px(14)};
  const float room = in.layout.view.width - taken - gui.px(60);
  std::vector<std::string> lines;
  float width = 0;
  for (const std::string& line : in.state.notes.lines) {
    lines.push_back(fit_text(gui.fonts.body, line, room));
    width = std::max(width, text_size(gui.fonts.body, lines.back()).x);
  }
  const float height = line_height * static_cast<float>(lines.size());
  draw_plate(gui, at, {at.x + width + 2 * pad, at.y + height + gui.px(12)}, draw);
  float y = at.y + gui.px(7);
  for (const std::string& line : lines) {
    draw_text(draw, gui.fonts.body, {at.x + pad, y},
              y == at.y + gui.px(7) ? gui.theme.text : gui.theme.text_dim, line);
    y += line_height;
  }
}

// The longest of 1, 2, 5 times a power of ten that is at most `length`.
double round_length(double length) {
  const double decade = std::pow(10.0, std::floor(std::log10(length)));
  return (length >= 5 * decade ? 5 : length >= 2 * decade ? 2 : 1) * decade;
}

void draw_scale_bar(const PanelInput& in, ImDrawList& draw) {
  const Gui& gui = in.gui;
  const double per_pixel = in.state.notes.metres_per_pixel;
  if (!(per_pixel > 0)) return;
  const double length = round_length(per_pixel * gui.px(150));
  const float width = static_cast<float>(length / per_pixel);
  const ImVec2 at = {in.layout.view.x + gui.px(24), in.layout.view.bottom() - gui.px(24)};
  const ImU32 colour = u32(gui.theme.text);
  draw_plate(gui, {at.x - gui.px(8), at.y - gui.px(28)}, {at.x + width + gui.px(8), at.y + gui.px(8)}, draw);
  draw.AddLine(at, {at.x + width, at.y}, colour, gui.px(2));
  for (const float x : {at.x, at.x + width})
    draw.AddLine({x, at.y - gui.px(4)}, {x, at.y + gui.px(1)}, colour, gui.px(1.5f));
  const std::string text = quantity(length, Dimension::length, 1);
  draw_text(
      draw, gui.fonts.small,
      {at.x + (width - text_size(gui.fonts.small, text).x) / 2, at.y - gui.px(8) - gui.fonts.small->FontSize},
      gui.theme.text, text);
}

void draw_contour(const PanelInput& in, ImDrawList& draw) {
  const Gui& gui = in.gui;
  const std::vector<Eigen::Vector2d>& contour = in.state.contour;
  if (contour.empty()) return;
  std::vector<ImVec2> points;
  points.reserve(contour.size());
  for (const Eigen::Vector2d& p : contour) {
    points.push_back(
        {in.layout.view.x + static_cast<float>(p.x()), in.layout.view.y + static_cast<float>(p.y())});
  }
  const Theme& theme = gui.theme;
  const bool takes_away = in.state.contour_mode == SelectMode::subtract;
  const Rgba colour = takes_away ? theme.bad : theme.accent;
  draw.AddPolyline(points.data(), static_cast<int>(points.size()), u32(colour), 0, gui.px(1.75f));
  draw.AddLine(points.back(), points.front(), u32(with_alpha(colour, 0.45f)), gui.px(1.25f));
  const float r = gui.px(in.state.contour_closes ? 6.5f : 4);
  draw.AddCircleFilled(points.front(), r, u32(in.state.contour_closes ? theme.good : colour), 20);
}

// What the contour will do, beside the pointer.
void draw_badge(const PanelInput& in, ImDrawList& draw) {
  const char* badge = nullptr;
  switch (in.state.contour_mode) {
    case SelectMode::set:
      return;
    case SelectMode::add:
      badge = "+";
      break;
    case SelectMode::subtract:
      badge = "\u2212";
      break;
    case SelectMode::intersect:
      badge = "\u2229";
      break;
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (in.state.tool == Tool::orbit || !in.layout.view.contains(mouse.x, mouse.y)) return;
  draw_text(draw, in.gui.fonts.title, {mouse.x + in.gui.px(12), mouse.y + in.gui.px(6)}, in.gui.theme.text,
            badge);
}

// Text that can be read over anything: with a rim in the colour of the panels.
void draw_rimmed(const Gui& gui, ImDrawList& draw, ImVec2 at, const Rgba& colour, const std::string& text) {
  const float rim = gui.px(1.25f);
  for (const ImVec2 aside : {ImVec2{-rim, 0}, ImVec2{rim, 0}, ImVec2{0, -rim}, ImVec2{0, rim}}) {
    draw_text(draw, gui.fonts.strong, {at.x + aside.x, at.y + aside.y}, gui.theme.panel, text);
  }
  draw_text(draw, gui.fonts.strong, at, colour, text);
}

// Labels that would overlap one before them move down past it.
void draw_labels(const PanelInput& in, ImDrawList& draw) {
  std::vector<Rect> taken;
  const Rect& view = in.layout.view;
  for (const SceneNotes::Label& label : in.state.notes.labels) {
    const ImVec2 size = text_size(in.gui.fonts.strong, label.text);
    const auto x = static_cast<float>(label.pixel.x()), y = static_cast<float>(label.pixel.y());
    if (x < 0 || y < 0 || x > view.width || y > view.height) continue;
    Rect at = {view.x + std::clamp(x - size.x / 2, 2.0f, view.width - size.x - 2.0f), view.y + y - size.y / 2,
               size.x, size.y};
    for (const Rect& other : taken) {
      const bool apart = at.right() <= other.x || other.right() <= at.x || std::abs(other.y - at.y) >= size.y;
      if (!apart) at.y = other.bottom();
    }
    taken.push_back(at);
    draw_rimmed(in.gui, draw, corner(at), label.colour, label.text);
  }
}

// Where nothing is open: what to do first.
void draw_invitation(const PanelInput& in, ImDrawList& draw) {
  const Gui& gui = in.gui;
  if (in.state.busy) return;
  const struct {
    ImFont* font;
    Rgba colour;
    const char* text;
  } lines[] = {{gui.fonts.title, gui.theme.text, "Drop a scan here"},
               {gui.fonts.body, gui.theme.text_dim,
                "or press Ctrl+O to open one: PCD, PLY, XYZ, CSV, OBJ, OFF, STL, depth images"},
               {gui.fonts.body, gui.theme.text_dim, "then L, draw round a surface, Enter keeps the patch"}};
  const Rect& view = in.layout.view;
  float y = view.y + view.height * 0.44f;
  for (const auto& line : lines) {
    const std::string shown = fit_text(line.font, line.text, view.width - gui.px(40));
    draw_text(draw, line.font, {view.x + (view.width - text_size(line.font, shown).x) / 2, y}, line.colour,
              shown);
    y += line.font->FontSize + gui.px(10);
  }
}

}  // namespace

void draw_overlay(const PanelInput& in) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const Rect& view = in.layout.view;
  draw.PushClipRect(corner(view), far_corner(view));
  if (in.document.scans.empty() && in.document.maps.empty() && in.document.robots.empty()) {
    draw_invitation(in, draw);
    return draw.PopClipRect();
  }
  draw_labels(in, draw);
  draw_measured_line(in, draw);
  draw_contour(in, draw);
  draw_badge(in, draw);
  draw_notes(in, draw_pill(in, draw), draw);
  draw_scale_bar(in, draw);
  draw_colour_bars(in, draw);
  draw.PopClipRect();
}

}  // namespace patchlab::viewer
