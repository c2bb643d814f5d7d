#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/platform/gui_frame.h"
#include "viewer/platform/key.h"
#include "viewer/platform/make_platform.h"

namespace patchlab::viewer {
namespace {

// Keys have GLFW's codes.
static_assert(key::escape == GLFW_KEY_ESCAPE && key::enter == GLFW_KEY_ENTER && key::tab == GLFW_KEY_TAB &&
              key::backspace == GLFW_KEY_BACKSPACE && key::insert == GLFW_KEY_INSERT &&
              key::del == GLFW_KEY_DELETE);
static_assert(key::right == GLFW_KEY_RIGHT && key::left == GLFW_KEY_LEFT && key::down == GLFW_KEY_DOWN &&
              key::up == GLFW_KEY_UP && key::page_up == GLFW_KEY_PAGE_UP &&
              key::page_down == GLFW_KEY_PAGE_DOWN && key::home == GLFW_KEY_HOME && key::end == GLFW_KEY_END);
static_assert(key::f1 == GLFW_KEY_F1 && key::f5 == GLFW_KEY_F5 && key::f12 == GLFW_KEY_F12 &&
              key::pad_0 == GLFW_KEY_KP_0 && key::pad_subtract == GLFW_KEY_KP_SUBTRACT &&
              key::pad_add == GLFW_KEY_KP_ADD && key::pad_enter == GLFW_KEY_KP_ENTER);
static_assert(key::left_shift == GLFW_KEY_LEFT_SHIFT && key::left_control == GLFW_KEY_LEFT_CONTROL &&
              key::left_alt == GLFW_KEY_LEFT_ALT && key::right_shift == GLFW_KEY_RIGHT_SHIFT &&
              key::right_control == GLFW_KEY_RIGHT_CONTROL && key::right_alt == GLFW_KEY_RIGHT_ALT);

std::string glfw_reason() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return reason != nullptr ? reason : "no reason given";
}

// One window with a current OpenGL 3.3 core context. GLFW stays initialised for the whole process: its end
// would unload the graphics driver, which not every driver takes well.
class Window {
 public:
  Window() = default;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
  }

  Result<void> open(const PlatformOptions& options) {
    if (glfwInit() != GLFW_TRUE)
      return Error{ErrorCode::usage, "No window can be opened (" + glfw_reason() +
                                         "); start the viewer in a desktop session, or with --headless."};
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr)
      return Error{ErrorCode::usage,
                   "No window with OpenGL 3.3 can be opened (" + glfw_reason() +
                       "); update the graphics driver, set LIBGL_ALWAYS_SOFTWARE=1 to draw without "
                       "it, or use --headless."};
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    return check_gl();
  }
  GLFWwindow* get() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

float monitor_scale(GLFWwindow* window) {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window, &x, &y);
  return std::clamp(std::max(x, y), 0.5f, 4.0f);
}

class WindowPlatform : public Platform {
 public:
  WindowPlatform(std::unique_ptr<Window> window, const PlatformOptions& options)
      : window_(std::move(window)),
        follows_monitor_(options.scale <= 0.0f),
        frame_(options.scale > 0.0f ? options.scale : monitor_scale(handle()), options.samples) {
    glfwSetWindowUserPointer(handle(), this);
    glfwSetDropCallback(handle(), &WindowPlatform::drop);
    ImGui_ImplGlfw_InitForOpenGL(handle(), true);
    glfwSetKeyCallback(handle(), &WindowPlatform::key);
    measure();
  }
  ~WindowPlatform() override { ImGui_ImplGlfw_Shutdown(); }

  bool should_close() const override { return glfwWindowShouldClose(handle()) == GLFW_TRUE; }
  void request_close() override { glfwSetWindowShouldClose(handle(), GLFW_TRUE); }
  void wait_events(double seconds) override {
    if (seconds > 0.0) {
      glfwWaitEventsTimeout(seconds);
    } else {
      glfwPollEvents();
    }
  }
  void wake() override { glfwPostEmptyEvent(); }
  void begin_frame() override {
    measure();
    if (follows_monitor_ && !canvas_) frame_.set_scale(monitor_scale(handle()));
    ImGui_ImplGlfw_NewFrame();
    mouse_to_framebuffer();
    frame_.begin(width_, height_);
    release_late();
  }
  void end_frame() override {
    frame_.end();
    if (canvas_) return;
    frame_.present();
    glfwSwapBuffers(handle());
  }
  int width() const override { return width_; }
  int height() const override { return height_; }
  float scale() const override { return frame_.scale(); }
  void set_scale(float scale) override {
    follows_monitor_ = false;
    frame_.set_scale(scale);
  }
  const Fonts& fonts() const override { return frame_.fonts(); }
  void set_title(const std::string& title) override { glfwSetWindowTitle(handle(), title.c_str()); }
  void on_drop(std::function<void(const std::vector<std::string>&)> callback) override {
    dropped_ = std::move(callback);
  }
  void feed(const Input&) override {}
  void resize(int width, int height) override {
    glfwSetWindowSize(handle(), static_cast<int>(static_cast<float>(width) / pixels_per_unit_),
                      static_cast<int>(static_cast<float>(height) / pixels_per_unit_));
  }
  void set_canvas(const std::optional<Canvas>& canvas) override {
    if (!canvas_) own_scale_ = frame_.scale();
    canvas_ = canvas;
    frame_.set_scale(canvas ? canvas->scale : own_scale_);
  }
  void set_drawing(bool) override {}
  bool drawing() const override { return true; }
  Image read_image() override { return frame_.read(); }
  std::string gl_renderer() const override { return gl_renderer_name(); }

 private:
  static void drop(GLFWwindow* window, int count, const char** files) {
    const auto& callback = static_cast<WindowPlatform*>(glfwGetWindowUserPointer(window))->dropped_;
    if (callback) callback(std::vector<std::string>(files, files + count));
  }
  GLFWwindow* handle() const { return window_->get(); }

  // ImGui 1.86 looks at the keyboard once a frame: what goes down and up between two frames, and a modifier
  // that is let go in the same moment, would never be seen. Releases wait until it has looked.
  static void key(GLFWwindow* window, int code, int scancode, int action, int modifiers) {
    auto* self = static_cast<WindowPlatform*>(glfwGetWindowUserPointer(window));
    if (action == GLFW_RELEASE && self->key_pressed_) {
      self->late_releases_.push_back({code, scancode, modifiers});
      return;
    }
    self->key_pressed_ = self->key_pressed_ || action == GLFW_PRESS;
    ImGui_ImplGlfw_KeyCallback(window, code, scancode, action, modifiers);
  }
  void release_late() {
    key_pressed_ = false;
    for (const KeyRelease& late : late_releases_)
      ImGui_ImplGlfw_KeyCallback(handle(), late.code, late.scancode, GLFW_RELEASE, late.modifiers);
    late_releases_.clear();
  }

  // A minimised window has no pixels; it is drawn as if it had one.
  void measure() {
    int units = 0, unused = 0;
    glfwGetFramebufferSize(handle(), &width_, &height_);
    glfwGetWindowSize(handle(), &units, &unused);
    if (canvas_) {
      width_ = canvas_->width;
      height_ = canvas_->height;
      return;
    }
    width_ = std::max(width_, 1);
    height_ = std::max(height_, 1);
    pixels_per_unit_ = static_cast<float>(width_) / static_cast<float>(std::max(units, 1));
  }
  void mouse_to_framebuffer() const {
    ImVec2& mouse = ImGui::GetIO().MousePos;
    if (canvas_) mouse = {-FLT_MAX, -FLT_MAX};
    if (!ImGui::IsMousePosValid(&mouse)) return;
    mouse = ImVec2(mouse.x * pixels_per_unit_, mouse.y * pixels_per_unit_);
  }

  std::unique_ptr<Window> window_;
  bool follows_monitor_;
  GuiFrame frame_;
  std::function<void(const std::vector<std::string>&)> dropped_;
  struct KeyRelease {
    int code, scancode, modifiers;
  };
  bool key_pressed_ = false;  // since ImGui looked last
  std::vector<KeyRelease> late_releases_;
  std::optional<Canvas> canvas_;
  float own_scale_ = 1.0f;
  int width_ = 1, height_ = 1;    // framebuffer px
  float pixels_per_unit_ = 1.0f;  // framebuffer px a screen unit, in which GLFW places the mouse
};

}  // namespace

Result<std::unique_ptr<Platform>> make_window_platform(const PlatformOptions& options) {
  auto window = std::make_unique<Window>();
  if (Result<void> opened = window->open(options); !opened) return opened.error();
  return std::unique_ptr<Platform>(std::make_unique<WindowPlatform>(std::move(window), options));
}

}  // namespace patchlab::viewer
