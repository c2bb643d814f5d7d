// A place to draw: a GLFW window, or an EGL surfaceless context with a framebuffer. Both give the same frame.
// ImGui's context and its OpenGL3 back end live here, with the GLFW back end for the window.
//
// A frame: begin_frame(), then in any order ImGui windows and GL drawing into the bound framebuffer
// (multisampled, with depth), then end_frame(), which lays ImGui over it. ImGui's coordinates (mouse,
// DisplaySize) are framebuffer pixels, x right, y down from the upper left corner, at every UI scale. Writes
// no ini file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/base/result.h"

struct ImFont;

namespace patchlab::viewer {

struct PlatformOptions {
  std::string title = "patchlab";
  int width = 1440, height = 900;  // px
  bool headless = false;
  float scale = 0.0f;  // UI scale; 0: from the monitor (1 where headless)
  // Of antialiasing; -1: 4, but none where OpenGL is software, which takes three times as long with them.
  int samples = -1;
};

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;         // row by row from the top
  std::vector<std::uint8_t> alpha = {};  // one a pixel, straight; empty: opaque
};
// unwritable error where the file cannot be written; it appears whole or not at all.
Result<void> write_png(const std::filesystem::path& file, const Image& image);

// Inter, embedded; made for the present UI scale: asked for in every frame, not kept. Digits are all equally
// wide. The glyphs: Latin, Greek, Cyrillic, superscripts, punctuation, arrows, mathematical signs and
// geometric shapes.
struct Fonts {
  ImFont* body;     // 13 px, ImGui's default font
  ImFont* small;    // 11 px: key hints, secondary numbers
  ImFont* heading;  // 11 px semi-bold: section titles, written in capitals
  ImFont* strong;   // 13 px semi-bold: verdicts
  ImFont* title;    // 15 px semi-bold: the name of what is shown
};

// What a mouse and a keyboard say, from a test or a replayed log. Held until the next one is given, but for
// wheel and text, which are of one frame. ImGui 1.86 looks once a frame: hover in one, press in a second,
// release in a third.
struct Input {
  float mouse_x = -1.0f, mouse_y = -1.0f;  // framebuffer px; negative: outside
  std::array<bool, 3> buttons{};           // left, right, middle
  float wheel = 0.0f;                      // notches, up positive
  std::set<int> keys{};                    // codes of key.h, in [0, 512)
  std::string text{};                      // UTF-8
};

// Where pictures of another size are drawn.
struct Canvas {
  int width = 0, height = 0;  // px
  float scale = 1.0f;         // of the UI
};

class Platform {
 public:
  virtual ~Platform() = default;

  virtual bool should_close() const = 0;
  virtual void request_close() = 0;
  // Waits for input at most `seconds` (0: polls). Headless: returns at once.
  virtual void wait_events(double seconds) = 0;
  // Wakes wait_events from another thread.
  virtual void wake() = 0;
  virtual void begin_frame() = 0;  // binds the target, starts the ImGui frame
  virtual void end_frame() = 0;    // renders ImGui, presents
  virtual int width() const = 0;   // framebuffer px
  virtual int height() const = 0;
  virtual void resize(int width, int height) = 0;  // px, for the frames from now on
  // For the frames from now on: they are drawn there and not presented, and the mouse is nowhere. Nothing: as
  // before. At most 16384 pixels a side.
  virtual void set_canvas(const std::optional<Canvas>& canvas) = 0;
  virtual float scale() const = 0;  // of the UI; follows the monitor where none was asked for
  // Between frames: remakes the fonts. Styles are the caller's to scale.
  virtual void set_scale(float scale) = 0;
  virtual const Fonts& fonts() const = 0;
  virtual void set_title(const std::string& title) = 0;
  virtual void on_drop(std::function<void(const std::vector<std::string>&)> callback) = 0;
  // For the frames from now on. A window listens to its user only.
  virtual void feed(const Input& input) = 0;
  // Whether frames are drawn. Where they are not, panels are laid out and answer all the same. A window
  // always draws.
  virtual void set_drawing(bool drawing) = 0;
  virtual bool drawing() const = 0;
  // The last frame that was drawn.
  virtual Image read_image() = 0;
  // What draws, for bug reports: "llvmpipe (LLVM 15.0.6, 256 bits)".
  virtual std::string gl_renderer() const = 0;
};

// The error names what is missing (no display, no GL 3.3) and what to do. One platform at a time: ImGui's and
// GL's contexts are current for its whole life, on the thread that made it.
Result<std::unique_ptr<Platform>> make_platform(const PlatformOptions& options);

}  // namespace patchlab::viewer
