// The window needs a display: without one it says so; with one (tests/run starts its own) it draws what the
// headless platform draws.
#include <gtest/gtest.h>
#include <imgui.h>

#include <cstdlib>
#include <string>

#include "viewer/platform/platform.h"

namespace patchlab::viewer {
namespace {

// An environment variable without a value, until the end of the scope.
class Unset {
 public:
  explicit Unset(const char* name) : name_(name) {
    const char* value = std::getenv(name);
    held_ = value != nullptr;
    if (held_) value_ = value;
    unsetenv(name);
  }
  Unset(const Unset&) = delete;
  Unset& operator=(const Unset&) = delete;
  ~Unset() {
    if (held_) setenv(name_, value_.c_str(), 1);
  }

 private:
  const char* name_;
  bool held_ = false;
  std::string value_;
};

Image picture(Platform& platform) {
  platform.begin_frame();
  ImGui::SetNextWindowPos({5, 5});
  ImGui::SetNextWindowSize({150, 60});
  ImGui::Begin("Fit inspector", nullptr, ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextUnformatted("\u03c3 0.21 mm");
  ImGui::End();
  platform.end_frame();
  return platform.read_image();
}

TEST(Window, WithoutADisplayItSaysWhatToDo) {
  const Unset x("DISPLAY"), wayland("WAYLAND_DISPLAY");
  const Result<std::unique_ptr<Platform>> made = make_platform({.width = 160, .height = 80});
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().code, ErrorCode::usage);
  EXPECT_NE(made.error().message.find("--headless"), std::string::npos) << made.error().message;
}

TEST(Window, DrawsWhatTheHeadlessPlatformDraws) {
  if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no display";
  Image window, headless;
  {
    Result<std::unique_ptr<Platform>> made = make_platform({.width = 160, .height = 80, .scale = 1.0f});
    ASSERT_TRUE(made.ok()) << made.error().message;
    window = picture(**made);
    EXPECT_FALSE((*made)->should_close());
    (*made)->request_close();
    EXPECT_TRUE((*made)->should_close());
    (*made)->wake();
    (*made)->wait_events(10.0);
  }
  {
    Result<std::unique_ptr<Platform>> made = make_platform({.width = 160, .height = 80, .headless = true});
    ASSERT_TRUE(made.ok()) << made.error().message;
    headless = picture(**made);
  }
  ASSERT_EQ(window.width, headless.width);
  ASSERT_EQ(window.height, headless.height);
  EXPECT_EQ(window.rgb, headless.rgb);
}

}  // namespace
}  // namespace patchlab::viewer
