#include "viewer/panel/scan_form.h"

#include <imgui_stdlib.h>

#include <charconv>
#include <utility>

#include "engine/base/file.h"
#include "viewer/platform/key.h"

namespace patchlab::viewer {

namespace fs = std::filesystem;

namespace {

struct UnitWords {
  LengthUnit unit;
  const char* text;
};
constexpr UnitWords units[] = {{LengthUnit::m, "Metre"},
                               {LengthUnit::mm, "Millimetre"},
                               {LengthUnit::cm, "Centimetre"},
                               {LengthUnit::in, "Inch"}};

std::optional<double> positive_number(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !(number > 0)) return std::nullopt;
  return number;
}

}  // namespace

void ScanForm::ask_camera(const fs::path& file, const std::string& why) {
  asks_ = Asks::camera;
  file_ = file;
  why_ = why;
  scan_.clear();
  message_.clear();
  focus_ = true;
  wishes_ = {};
}

void ScanForm::ask_unit(const fs::path& file, const std::string& why, const std::string& scan) {
  ask_camera(file, why);
  asks_ = Asks::unit;
  scan_ = scan;
  wishes_.unit = LengthUnit::mm;
}

void ScanForm::close() {
  asks_ = Asks::nothing;
  ImGui::CloseCurrentPopup();
}

bool ScanForm::read_camera() {
  std::error_code ignored;
  std::string text = camera_;
  if (fs::is_regular_file(camera_, ignored)) {
    const Result<Bytes> bytes = read_file(camera_);
    if (!bytes) {
      message_ = bytes.error().message;
      focus_ = true;
      return false;
    }
    text = as_text(*bytes);
  }
  const Result<Intrinsics> camera = parse_intrinsics(text, "The camera");
  const std::optional<double> scale = positive_number(scale_);
  if (!camera) message_ = camera.error().message;
  if (camera && !scale) message_ = "The depth scale is a positive number: raw units a metre.";
  focus_ = !camera || !scale;
  if (focus_) return false;
  wishes_.intrinsics = *camera;
  wishes_.depth_scale = *scale;
  return true;
}

void ScanForm::draw_camera(const Gui& gui) {
  paragraph(gui, gui.theme.text, "Focal lengths and centre in pixels: fx, fy, cx, cy");
  if (std::exchange(focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint(
      "##camera", "525, 525, 319.5, 239.5, or a file: ROS camera_info, Open3D JSON, a 3x3 matrix", &camera_);
  gui.note("scan form/camera");
  ImGui::Dummy({0, gui.px(4)});
  paragraph(gui, gui.theme.text,
            "Depth scale: raw units a metre (1000 for millimetres, 5000 for TUM's data sets)");
  ImGui::SetNextItemWidth(gui.px(140));
  ImGui::InputText("##scale", &scale_);
  gui.note("scan form/scale");
}

void ScanForm::draw_unit(const Gui& gui) {
  paragraph(gui, gui.theme.text, "What are the lengths in the file?");
  for (const UnitWords& choice : units) {
    const std::string name = std::string("scan form/") + choice.text;
    if (button(gui, name.c_str(), choice.text, {.chosen = wishes_.unit == choice.unit}))
      wishes_.unit = choice.unit;
    ImGui::SameLine(0, gui.px(6));
  }
  ImGui::NewLine();
}

void ScanForm::draw(const Gui& gui, Requests& out) {
  if (asks_ == Asks::nothing) return;
  if (!begin_dialog(gui, "scan form", {620, 330})) return;
  ImGui::PushFont(gui.fonts.title);
  ImGui::TextUnformatted(asks_ == Asks::camera ? "Which camera took this depth image?"
                                               : "In which unit is this scan?");
  ImGui::PopFont();
  paragraph(gui, gui.theme.text_dim, why_);
  ImGui::Dummy({0, gui.px(6)});
  asks_ == Asks::camera ? draw_camera(gui) : draw_unit(gui);
  ImGui::Dummy({0, gui.px(4)});
  paragraph(gui, gui.theme.doubt_text, message_);
  const bool in_metres = asks_ == Asks::unit && wishes_.unit == LengthUnit::m;
  const char* confirm = in_metres ? "Leave it so" : "Open";
  const float buttons = button_width(gui, "Cancel", "Esc") + button_width(gui, confirm, "Enter") + gui.px(30);
  ImGui::SetCursorPos(
      {ImGui::GetWindowWidth() - buttons - gui.px(14), ImGui::GetWindowHeight() - gui.px(48)});
  const bool cancelled = button(gui, "scan form/cancel", "Cancel", {.key = "Esc"});
  ImGui::SameLine();
  const bool pressed = button(gui, "scan form/open", confirm, {.key = "Enter", .strong = true});
  const bool entered = ImGui::IsKeyPressed(key::enter, false) || ImGui::IsKeyPressed(key::pad_enter, false);
  if (cancelled || ImGui::IsKeyPressed(key::escape, false)) {
    close();
  } else if (pressed || entered) {
    if (asks_ == Asks::unit || read_camera()) {
      if (!in_metres) out.open = OpenRequest{file_, wishes_, scan_};
      close();
    }
  }
  end_dialog();
}

}  // namespace patchlab::viewer
