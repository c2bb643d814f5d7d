#include <epoxy/egl.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "viewer/platform/gui_frame.h"
#include "viewer/platform/key.h"
#include "viewer/platform/make_platform.h"

namespace patchlab::viewer {
namespace {

constexpr float kFrameTime = 1.0f / 60.0f;  // s, of every frame: what is drawn never depends on the clock

constexpr std::pair<ImGuiKey_, int> kKeyMap[] = {
    {ImGuiKey_Tab, key::tab},
    {ImGuiKey_LeftArrow, key::left},
    {ImGuiKey_RightArrow, key::right},
    {ImGuiKey_UpArrow, key::up},
    {ImGuiKey_DownArrow, key::down},
    {ImGuiKey_PageUp, key::page_up},
    {ImGuiKey_PageDown, key::page_down},
    {ImGuiKey_Home, key::home},
    {ImGuiKey_End, key::end},
    {ImGuiKey_Insert, key::insert},
    {ImGuiKey_Delete, key::del},
    {ImGuiKey_Backspace, key::backspace},
    {ImGuiKey_Space, ' '},
    {ImGuiKey_Enter, key::enter},
    {ImGuiKey_Escape, key::escape},
    {ImGuiKey_KeyPadEnter, key::pad_enter},
    {ImGuiKey_A, 'A'},
    {ImGuiKey_C, 'C'},
    {ImGuiKey_V, 'V'},
    {ImGuiKey_X, 'X'},
    {ImGuiKey_Y, 'Y'},
    {ImGuiKey_Z, 'Z'},
};

// An OpenGL 3.3 core context without a window or a display. EGL's surfaceless display is one for the whole
// process and stays initialised.
class EglContext {
 public:
  EglContext() = default;
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  }

  bool make_current() {
    if (!epoxy_has_egl() || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
      return false;
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr)) return false;
    constexpr EGLint config[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    constexpr EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  3,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
    EGLConfig chosen = nullptr;
    EGLint count = 0;
    if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display_, config, &chosen, 1, &count) || count == 0)
      return false;
    context_ = eglCreateContext(display_, chosen, EGL_NO_CONTEXT, version);
    return context_ != EGL_NO_CONTEXT && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

class HeadlessPlatform : public Platform {
 public:
  HeadlessPlatform(std::unique_ptr<EglContext> context, const PlatformOptions& options)
      : context_(std::move(context)),
        width_(options.width),
        height_(options.height),
        frame_(options.scale > 0.0f ? options.scale : 1.0f, options.samples) {
    ImGuiIO& io = ImGui::GetIO();
    for (const auto& [meaning, code] : kKeyMap) io.KeyMap[meaning] = code;
  }

  bool should_close() const override { return closing_; }
  void request_close() override { closing_ = true; }
  void wait_events(double) override {}
  void wake() override {}
  void begin_frame() override {
    put_input();
    ImGui::GetIO().DeltaTime = kFrameTime;
    frame_.begin(width(), height());
  }
  void end_frame() override {
    if (drawing_)
      frame_.end();
    else
      ImGui::Render();
  }
  int width() const override { return canvas_ ? canvas_->width : width_; }
  int height() const override { return canvas_ ? canvas_->height : height_; }
  float scale() const override { return frame_.scale(); }
  void set_scale(float scale) override { frame_.set_scale(scale); }
  const Fonts& fonts() const override { return frame_.fonts(); }
  void set_title(const std::string&) override {}
  void on_drop(std::function<void(const std::vector<std::string>&)>) override {}
  void feed(const Input& input) override { input_ = input; }
  void resize(int width, int height) override {
    width_ = width;
    height_ = height;
  }
  void set_canvas(const std::optional<Canvas>& canvas) override {
    if (!canvas_) own_scale_ = frame_.scale();
    canvas_ = canvas;
    frame_.set_scale(canvas ? canvas->scale : own_scale_);
  }
  void set_drawing(bool drawing) override { drawing_ = drawing; }
  bool drawing() const override { return drawing_; }
  Image read_image() override { return frame_.read(); }
  std::string gl_renderer() const override { return gl_renderer_name(); }

 private:
  bool down(int code) const { return input_.keys.contains(code); }

  void put_input() {
    ImGuiIO& io = ImGui::GetIO();
    const bool outside = canvas_ || input_.mouse_x < 0.0f || input_.mouse_y < 0.0f;
    io.MousePos = outside ? ImVec2(-FLT_MAX, -FLT_MAX) : ImVec2(input_.mouse_x, input_.mouse_y);
    std::copy(input_.buttons.begin(), input_.buttons.end(), io.MouseDown);
    io.MouseWheel = std::exchange(input_.wheel, 0.0f);
    std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
    for (const int code : input_.keys) io.KeysDown[code] = true;
    io.KeyCtrl = down(key::left_control) || down(key::right_control);
    io.KeyShift = down(key::left_shift) || down(key::right_shift);
    io.KeyAlt = down(key::left_alt) || down(key::right_alt);
    io.AddInputCharactersUTF8(std::exchange(input_.text, {}).c_str());
  }

  std::unique_ptr<EglContext> context_;
  int width_, height_;
  GuiFrame frame_;
  Input input_;
  std::optional<Canvas> canvas_;
  float own_scale_ = 1.0f;
  bool drawing_ = true, closing_ = false;
};

}  // namespace

Result<std::unique_ptr<Platform>> make_headless_platform(const PlatformOptions& options) {
  auto context = std::make_unique<EglContext>();
  if (!context->make_current())
    return Error{ErrorCode::usage,
                 "No OpenGL 3.3 without a display: EGL offers no surfaceless context; install Mesa's drivers "
                 "(libegl1 and libgl1-mesa-dri)."};
  if (Result<void> checked = check_gl(); !checked) return checked.error();
  return std::unique_ptr<Platform>(std::make_unique<HeadlessPlatform>(std::move(context), options));
}

}  // namespace patchlab::viewer
