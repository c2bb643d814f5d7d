#include "viewer/panel/panels.h"

namespace patchlab::viewer {

void draw_panels(const PanelInput& in, PanelMemory& memory, Requests& out) {
  draw_overlay(in);
  draw_toasts(in);
  draw_tree(in, memory, out);
  draw_inspector(in, memory, out);
  draw_tool_bar(in, out);
  draw_menu_bar(in, out);
  draw_status_bar(in, out);
  draw_help_sheet(in, memory);
  memory.files.draw(in.gui, out);
}

}  // namespace patchlab::viewer
