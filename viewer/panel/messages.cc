// Everything that the program said since it was started: what a toast showed for a moment, to be read again.
#include <imgui.h>

#include "viewer/panel/panels.h"
#include "viewer/platform/key.h"

namespace patchlab::viewer {

void draw_messages(const PanelInput& in, PanelMemory& memory) {
  if (!memory.messages) return;
  const Gui& gui = in.gui;
  if (!begin_dialog(gui, "messages", {680, 420})) return;
  ImGui::PushFont(gui.fonts.title);
  ImGui::TextUnformatted("Messages");
  ImGui::PopFont();
  ImGui::BeginChild("said", {0, -gui.px(40)});
  if (in.state.messages.empty()) paragraph(gui, gui.theme.text_dim, "Nothing was said so far.");
  for (auto said = in.state.messages.rbegin(); said != in.state.messages.rend(); ++said) {
    paragraph(gui, said->is_error ? gui.theme.bad_text : gui.theme.text, said->text);
    ImGui::Dummy({0, gui.px(4)});
  }
  ImGui::EndChild();
  ImGui::SetCursorPosX(ImGui::GetWindowWidth() - gui.px(22) - button_width(gui, "Close", "Esc"));
  if (button(gui, "messages/close", "Close", {.key = "Esc", .strong = true}) ||
      ImGui::IsKeyPressed(key::escape, false)) {
    memory.messages = false;
    ImGui::CloseCurrentPopup();
  }
  end_dialog();
}

}  // namespace patchlab::viewer
