// What colours mean: bars at the right of the view, with their unit.
#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

// A vertical bar at the right of the view, with three labels and a title below.
struct ColourBar {
  std::array<std::string, 3> labels;  // low, middle, high
  const char* title;
  bool diverging = false;
};
constexpr float bar_apart = 104;  // px, from one bar to the next

Rgba colour_of(const ColourBar& bar, double t, const PanelInput& in) {
  return bar.diverging ? diverging(2 * t - 1, in.gui.theme.neutral_lightness) : sequential(t, in.state.map);
}

// `place`: 0 is the first from the right.
void draw_colour_bar(const PanelInput& in, const ColourBar& bar, int place, ImDrawList& draw) {
  const Gui& gui = in.gui;
  const float width = gui.px(12), height = std::min(gui.px(170), in.layout.view.height * 0.4f);
  const ImVec2 at = {in.layout.view.right() - gui.px(30 + bar_apart * static_cast<float>(place)),
                     in.layout.view.y + (in.layout.view.height - height) / 2};
  float label_space = text_size(gui.fonts.small, bar.title).x - width;
  for (const std::string& label : bar.labels) {
    label_space = std::max(label_space, text_size(gui.fonts.small, label).x + gui.px(6));
  }
  draw_plate(gui, {at.x - label_space - gui.px(10), at.y - gui.px(14)},
             {at.x + width + gui.px(10), at.y + height + gui.px(32)}, draw);
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const float from = at.y + height * static_cast<float>(steps - 1 - i) / steps;
    draw.AddRectFilled({at.x, from}, {at.x + width, from + height / steps + 0.5f},
                       u32(colour_of(bar, (i + 0.5) / steps, in)));
  }
  for (std::size_t i = 0; i < bar.labels.size(); ++i) {
    const float y = at.y + height * (1.0f - static_cast<float>(i) / 2) - gui.fonts.small->FontSize / 2;
    draw_text_right(draw, gui.fonts.small, {at.x - gui.px(6), y}, gui.theme.text, bar.labels[i]);
  }
  draw_text_right(draw, gui.fonts.small, {at.x + width, at.y + height + gui.px(10)}, gui.theme.text_dim,
                  bar.title);
}

// From `range.x()` to `range.y()`, with as many decimals as tell its ends apart.
std::array<std::string, 3> bar_labels(const Eigen::Vector2d& range) {
  if (!range.allFinite()) return {"", "unknown", ""};
  const double largest = std::max(range.cwiseAbs().maxCoeff(), 1e-6);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(largest))), 0, 4);
  return {fixed(range.x(), decimals), fixed(range.mean(), decimals), fixed(range.y(), decimals)};
}

}  // namespace

void draw_colour_bars(const PanelInput& in, ImDrawList& draw) {
  const SceneNotes& notes = in.state.notes;
  int place = 0;
  if (notes.residual_colours) {
    draw_colour_bar(in, {{"\u22123", "0", "3"}, "residual, σ", true}, place++, draw);
  } else if (notes.height_sigma) {
    draw_colour_bar(in, {bar_labels(*notes.height_sigma * 1e3), "height σ, mm"}, place++, draw);
  }
  if (notes.points) draw_colour_bar(in, {bar_labels(notes.points->range), notes.points->title}, place, draw);
}

}  // namespace patchlab::viewer
