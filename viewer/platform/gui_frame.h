// One frame, the same in a window and without: ImGui's context, its fonts and OpenGL3 back end, and the
// target. A current GL context is required for its whole life.
#pragma once

#include "viewer/platform/fonts.h"
#include "viewer/platform/frame_target.h"

namespace patchlab::viewer {

class GuiFrame {
 public:
  GuiFrame(float scale, int samples);  // samples as in PlatformOptions
  GuiFrame(const GuiFrame&) = delete;
  GuiFrame& operator=(const GuiFrame&) = delete;
  ~GuiFrame();

  // The caller has filled ImGuiIO (time, mouse, keys); the display is width x height.
  void begin(int width, int height);
  void end();
  void present() const { target_.present(); }
  Image read() const { return target_.read(); }

  float scale() const { return scale_; }
  void set_scale(float scale);
  const Fonts& fonts() const { return fonts_; }

 private:
  FrameTarget target_;
  float scale_;
  Fonts fonts_;
};

// Nothing where the current context is OpenGL 3.3 or newer, otherwise the sentence that says so.
Result<void> check_gl();
std::string gl_renderer_name();

}  // namespace patchlab::viewer
