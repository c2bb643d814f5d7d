#include "viewer/panel/panels.h"

namespace patchlab::viewer {

void draw_panels(const PanelInput& in, PanelMemory& memory, Requests& out) {
  draw_overlay(in);
  draw_slab(in, out);
  draw_toasts(in);
  if (in.state.side_panels) {
    draw_splitters(in, out);  // before what they lie over: ImGui puts later windows of this kind behind
    draw_tree(in, memory, out);
    draw_inspector(in, memory, out);
  }
  draw_tool_bar(in, out);
  draw_menu_bar(in, out);
  draw_status_bar(in, out);
  draw_help_sheet(in, memory);
  draw_palette(in, memory, out);
  draw_messages(in, memory);
  memory.files.draw(in, out);
  memory.scan_form.draw(in.gui, out);
}

}  // namespace patchlab::viewer
