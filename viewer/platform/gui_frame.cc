#include "viewer/platform/gui_frame.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/platform/software_gl.h"

namespace patchlab::viewer {

namespace {

constexpr GLint kSamples = 4;

int possible_samples(int wanted) {
  if (wanted < 0) wanted = is_software_gl() ? 0 : kSamples;
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  return std::min(wanted, most);
}

}  // namespace

GuiFrame::GuiFrame(float scale, int samples) : target_(possible_samples(samples)), scale_(scale) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  fonts_ = load_fonts(scale);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

GuiFrame::~GuiFrame() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void GuiFrame::set_scale(float scale) {
  if (scale == scale_) return;
  scale_ = scale;
  fonts_ = load_fonts(scale);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void GuiFrame::begin(int width, int height) {
  target_.begin(width, height);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DisplayFramebufferScale = ImVec2(1.0f, 1.0f);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void GuiFrame::end() {
  ImGui::Render();
  target_.resolve();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Result<void> check_gl() {
  if (epoxy_gl_version() >= 33) return {};
  return Error{ErrorCode::usage,
               "The graphics driver offers OpenGL " + std::to_string(epoxy_gl_version() / 10) + "." +
                   std::to_string(epoxy_gl_version() % 10) +
                   ", but the viewer needs 3.3; update the driver, or set LIBGL_ALWAYS_SOFTWARE=1 "
                   "to draw without it."};
}

std::string gl_renderer_name() { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

}  // namespace patchlab::viewer
