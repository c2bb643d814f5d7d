#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

std::string hint(const ViewState& state) {
  if (state.drawing) {
    return "Release, double click or Enter closes  ·  Backspace takes a corner back  ·  right drag, middle drag and "
           "wheel navigate  ·  Esc drops it";
  }
  if (!state.draft.empty()) {
    return "Enter keeps the patch  ·  Shift adds points, Ctrl subtracts  ·  0 to 4 choose the surface  ·  Esc discards";
  }
  if (state.tool == Tool::lasso) {
    return "Lasso: drag to draw, click for corners  ·  Shift adds, Ctrl subtracts  ·  right drag turns";
  }
  if (state.tool == Tool::rectangle) {
    return "Rectangle: drag from corner to corner  ·  Shift adds, Ctrl subtracts  ·  right drag turns";
  }
  if (state.tool == Tool::surface) {
    return "Smooth surface: click a point of it  ·  Shift adds, Ctrl subtracts  ·  right drag turns";
  }
  if (state.tool == Tool::measure) {
    return "Measure: click two points  ·  right drag turns  ·  Esc takes the line away";
  }
  return "Drag turns, middle drag moves, wheel zooms, double click sets the pivot  ·  L draws a lasso  ·  F1 help";
}

std::string selected_words(const PanelInput& in) {
  const PatchEntry* patch = find_patch(in.document, in.state.selected);
  const RegionEntry* region = find_region(in.document, patch ? patch->region : in.state.selected);
  if (!region || !region->points || region->points->empty()) return {};
  const std::string words = count(region->points->size()) + " selected";
  if (region->hidden_left_out == 0) return words;
  return words + " (" + count(region->hidden_left_out) + " hidden left out)";
}

std::string facts(const PanelInput& in) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : "  ·  ") + part; };
  if (const std::string selected = selected_words(in); !selected.empty()) add(selected);
  if (in.state.currency == Currency::current && in.state.fit_milliseconds > 0) {
    add("fit " + duration(in.state.fit_milliseconds * 1e-3));
  }
  if (!in.state.saved.empty()) {
    add(in.state.saved + " in " + fit_path(in.gui.fonts.body, in.state.journal, in.gui.px(300)));
  }
  return text;
}

// Progress of the work in the background, with a way to stop it.
void draw_busy(const PanelInput& in, const Busy& busy, Requests& out) {
  const Gui& gui = in.gui;
  const Rect& bar = in.layout.status;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float track = gui.px(120), y = bar.y + bar.height / 2;
  const float text_width = text_size(gui.fonts.body, busy.what).x;
  float x = bar.x + gui.px(14);
  draw_text(draw, gui.fonts.body, {x, y - gui.fonts.body->FontSize / 2}, gui.theme.text, busy.what);
  x += text_width + gui.px(12);
  const float filled = track * static_cast<float>(busy.fraction);
  draw.AddRectFilled({x, y - gui.px(2)}, {x + track, y + gui.px(2)}, u32(gui.theme.line), gui.px(2));
  draw.AddRectFilled({x, y - gui.px(2)}, {x + filled, y + gui.px(2)}, u32(gui.theme.accent), gui.px(2));
  x += track + gui.px(8);
  ImGui::SetCursorScreenPos({x, bar.y + gui.px(1)});
  if (button(gui, "status/cancel", "Cancel")) out.cancel_work = true;
}

}  // namespace

void draw_status_bar(const PanelInput& in, Requests& out) {
  const Gui& gui = in.gui;
  const Rect& bar = in.layout.status;
  begin_panel("status", bar, gui.theme.bar, {0, 0});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float y = bar.y + (bar.height - gui.fonts.body->FontSize) / 2, right = bar.right() - gui.px(14);
  const std::string said = facts(in);
  draw_text_right(draw, gui.fonts.body, {right, y}, gui.theme.text_dim, said);
  if (!in.state.journal.empty() &&
      ImGui::IsMouseHoveringRect({right - text_size(gui.fonts.body, said).x, bar.y}, {right, bar.bottom()})) {
    ImGui::SetTooltip("%s", in.state.journal.c_str());
  }
  if (in.state.busy) {
    draw_busy(in, *in.state.busy, out);
  } else {
    const float space = right - text_size(gui.fonts.body, said).x - bar.x - gui.px(40);
    draw_text(draw, gui.fonts.body, {bar.x + gui.px(14), y}, gui.theme.text_dim,
              fit_text(gui.fonts.body, hint(in.state), space));
  }
  end_panel();
}

}  // namespace patchlab::viewer
