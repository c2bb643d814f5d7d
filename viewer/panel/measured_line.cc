// A measured distance over the scene: its two ends, the line between them, and what it came to.
#include <algorithm>

#include "viewer/panel/colours.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

void draw_measured_line(const PanelInput& in, ImDrawList& draw) {
  if (!in.state.measured) return;
  const Gui& gui = in.gui;
  const MeasuredLine& line = *in.state.measured;
  const auto at = [&in](const Eigen::Vector2d& pixel) {
    return ImVec2(in.layout.view.x + static_cast<float>(pixel.x()),
                  in.layout.view.y + static_cast<float>(pixel.y()));
  };
  const ImU32 rim = u32(gui.theme.panel), colour = u32(gui.theme.accent);
  if (line.ends.size() == 2) {
    draw.AddLine(at(line.ends[0]), at(line.ends[1]), rim, gui.px(4));
    draw.AddLine(at(line.ends[0]), at(line.ends[1]), colour, gui.px(2));
  }
  for (const Eigen::Vector2d& end : line.ends) {
    draw.AddCircleFilled(at(end), gui.px(5.5f), rim, 20);
    draw.AddCircleFilled(at(end), gui.px(4), colour, 20);
  }
  if (line.ends.empty() || line.text.empty()) return;
  const ImVec2 size = text_size(gui.fonts.strong, line.text), pad = {gui.px(9), gui.px(5)};
  const ImVec2 first = at(line.ends.front()), last = at(line.ends.back());
  const Rect& view = in.layout.view;
  ImVec2 corner = {(first.x + last.x - size.x) / 2, (first.y + last.y) / 2 - size.y - gui.px(16)};
  corner.x = std::clamp(corner.x, view.x + pad.x, std::max(view.x + pad.x, view.right() - size.x - pad.x));
  corner.y = std::clamp(corner.y, view.y + pad.y, std::max(view.y + pad.y, view.bottom() - size.y - pad.y));
  draw.AddRectFilled({corner.x - pad.x, corner.y - pad.y},
                     {corner.x + size.x + pad.x, corner.y + size.y + pad.y},
                     u32(with_alpha(gui.theme.popup, 0.94f)), gui.px(6));
  draw_text(draw, gui.fonts.strong, corner, gui.theme.text, line.text);
}

}  // namespace patchlab::viewer
