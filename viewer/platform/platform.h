// A place to draw: a GLFW window, or an EGL surfaceless context with a framebuffer. Both give the same frame.
// ImGui's context and its OpenGL3 back end live here, with the GLFW back end for the window.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace patchlab::viewer {

struct PlatformOptions {
  std::string title = "patchlab";
  int width = 1440, height = 900;                // px
  bool headless = false;
  float scale = 0.0f;                            // UI scale; 0: from the monitor (1 where headless)
};

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;                 // row by row from the top
};
Result<void> write_png(const std::filesystem::path& file, const Image& image);

class Platform {
 public:
  virtual ~Platform() = default;

  virtual bool should_close() const = 0;
  virtual void request_close() = 0;
  // Waits for input at most `seconds` (0: polls). Headless: returns at once.
  virtual void wait_events(double seconds) = 0;
  // Wakes wait_events from another thread.
  virtual void wake() = 0;
  virtual void begin_frame() = 0;                // binds the target, starts the ImGui frame
  virtual void end_frame() = 0;                  // renders ImGui, presents
  virtual int width() const = 0;                 // framebuffer px
  virtual int height() const = 0;
  virtual float scale() const = 0;               // UI scale
  virtual void set_title(const std::string& title) = 0;
  virtual void on_drop(std::function<void(const std::vector<std::string>&)> callback) = 0;
  virtual Image read_image() = 0;                // the last finished frame
};

// unwritable is never used here; an error names what is missing (no display, no GL 3.3) and what to do.
Result<std::unique_ptr<Platform>> make_platform(const PlatformOptions& options);

}  // namespace patchlab::viewer
