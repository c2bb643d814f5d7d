#include <algorithm>

#include "viewer/panel/colours.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

void draw_toasts(const PanelInput& in) {
  const Gui& gui = in.gui;
  const Rect& view = in.layout.view;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const float wrap = std::min(gui.px(520), view.width - gui.px(80)), pad = gui.px(14);
  float bottom = view.bottom() - gui.px(56);
  for (auto toast = in.state.toasts.rbegin(); toast != in.state.toasts.rend(); ++toast) {
    ImFont* font = gui.fonts.body;
    const ImVec2 size = text_size(font, toast->text, wrap);
    const ImVec2 at = {view.x + (view.width - size.x) / 2 - pad, bottom - size.y - 2 * pad};
    const ImVec2 end = {at.x + size.x + 2 * pad, bottom};
    draw.AddRectFilled(at, end, u32(gui.theme.popup), gui.px(8));
    draw.AddRect(at, end, u32(toast->is_error ? gui.theme.bad : gui.theme.line), gui.px(8), 0, gui.px(1));
    draw.AddText(font, font->FontSize, {at.x + pad, at.y + pad}, u32(gui.theme.text), toast->text.c_str(),
                 nullptr, wrap);
    bottom = at.y - gui.px(10);
  }
}

}  // namespace patchlab::viewer
