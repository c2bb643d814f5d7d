// What every panel draws with: theme, fonts, scale, and the few shapes that ImGui lacks.
#pragma once

#include <imgui.h>

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "viewer/panel/layout.h"
#include "viewer/panel/theme.h"
#include "viewer/platform/platform.h"

namespace patchlab::viewer {

// Where the widgets of the last frame are, by name ("tools/Sphere"): how tests and replayed logs find them.
using WidgetMap = std::map<std::string, Rect>;

struct Gui {
  Theme theme;
  Fonts fonts{};
  float scale = 1.0f;
  WidgetMap* widgets = nullptr;  // optional

  float px(float unscaled) const { return unscaled * scale; }
  // Remembers the last item under a name.
  void note(const std::string& name) const;
};

ImU32 u32(const Rgba& colour);
inline ImVec2 corner(const Rect& rect) { return {rect.x, rect.y}; }
inline ImVec2 far_corner(const Rect& rect) { return {rect.right(), rect.bottom()}; }

// Text in which "_x" is a subscript; returns its width.
float draw_label(const Gui& gui, ImDrawList& draw, ImVec2 at, const Rgba& colour, std::string_view text);

void draw_text(ImDrawList& draw, ImFont* font, ImVec2 at, const Rgba& colour, std::string_view text);
void draw_text_right(ImDrawList& draw, ImFont* font, ImVec2 right_at, const Rgba& colour,
                     std::string_view text);
ImVec2 text_size(ImFont* font, std::string_view text, float wrap_width = 0.0f);
// The longest beginning that fits, with an ellipsis where something was cut.
std::string fit_text(ImFont* font, std::string_view text, float width);
// The longest end that fits: what matters of a path.
std::string fit_path(ImFont* font, std::string_view path, float width);

// A ground that keeps text readable over any scan.
void draw_plate(const Gui& gui, ImVec2 from, ImVec2 to, ImDrawList& draw);

// A part of the shell: a window without decoration, on `ground`, closed by end_panel().
void begin_panel(const char* name, const Rect& rect, const Rgba& ground, ImVec2 padding,
                 bool scrolls = false);
void end_panel();

// A dialog in the middle of the window, at most `size` (unscaled); while it returns true, end_dialog() closes
// it. It keeps the rest of the program from being used.
bool begin_dialog(const Gui& gui, const char* name, ImVec2 size);
void end_dialog();

// Closes the popup that is being drawn when Esc is pressed.
void close_on_escape();

// Title of a section in a side panel, with a remark at its right.
void section(const Gui& gui, const char* title, std::string_view remark = {});
// Wrapped text in a colour of the theme.
void paragraph(const Gui& gui, const Rgba& colour, std::string_view text, ImFont* font = nullptr);
// A line of two ends: what, and its value at the right.
void fact(const Gui& gui, std::string_view what, std::string_view value, bool is_path = false);
// Help that appears when the pointer rests on the last item.
void tooltip(const Gui& gui, std::string_view text);

// A button of the tool bar or a dialog: text, the key beside it, lit where chosen. Returns true when pressed.
struct ButtonLook {
  std::string_view key = {};
  bool chosen = false;
  bool enabled = true;
  bool strong = false;  // the one that Enter would press
};
bool button(const Gui& gui, const char* name, std::string_view text, const ButtonLook& look = {});
// A slider over the width that is left; `part`, in [0, 1], follows the pointer. Returns true while it is
// held.
bool slider(const Gui& gui, const char* name, double& part);
float button_width(const Gui& gui, std::string_view text, std::string_view key);

}  // namespace patchlab::viewer
