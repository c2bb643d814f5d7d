// The whole program without a display, as tests use it: real panels, real input, real pixels.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "viewer/app/app.h"
#include "viewer/app/headless.h"

namespace patchlab::viewer {

struct Look {
  float scale;
  ThemeChoice theme;
};

inline Settings settings_of(const Look& look) {
  Settings settings;
  settings.theme = look.theme;
  return settings;
}

class Program {
 public:
  Program(const std::filesystem::path& journals, const Look& look, int width = 1200, int height = 760) {
    const auto pixels = [&look](int size) { return static_cast<int>(static_cast<float>(size) * look.scale); };
    auto made = make_platform({"test", pixels(width), pixels(height), true, look.scale});
    if (!made) throw std::runtime_error(made.error().message);
    platform_ = std::move(*made);
    Result<Renderer> renderer = Renderer::create();
    if (!renderer) throw std::runtime_error(renderer.error().message);
    app_.emplace(*platform_, std::move(*renderer), AppOptions{settings_of(look), journals, true});
  }
  App& app() { return *app_; }
  const Document& document() { return app_->workbench().document(); }

  // Frames from now on are drawn, or only laid out.
  void set_drawing(bool drawing) { platform_->set_drawing(drawing); }
  void settle() { run_until_settled(*app_, *platform_); }
  void play(const std::string& log) {
    const auto events = parse_input_log(log, "test");
    ASSERT_TRUE(events) << events.error().message;
    const Result<void> played = viewer::play(*events, *app_, *platform_);
    ASSERT_TRUE(played) << played.error().message;
    settle();
  }
  void resize(int width, int height) { platform_->resize(width, height); }
  Image image() { return platform_->read_image(); }
  // Also leaves the picture to be looked at.
  Image picture(const std::string& name) {
    const Image taken = image();
    EXPECT_TRUE(write_png(name + ".png", taken));
    return taken;
  }
  // A place for a log, from the middle of the view in parts of its height.
  std::string at(double right, double down) {
    const Rect view = app_->layout().view;
    return std::to_string(view.x + view.width / 2 + right * view.height) + " " +
           std::to_string(view.y + view.height / 2 + down * view.height) + " ";
  }
  // A freehand circle round the middle.
  std::string draw_circle(double radius) {
    std::string log = "drag ";
    for (int i = 0; i <= 36; ++i) {
      const double turn = 2 * std::numbers::pi * i / 37;
      log += at(radius * std::cos(turn), radius * std::sin(turn));
    }
    return log + "\n";
  }

 private:
  std::unique_ptr<Platform> platform_;
  std::optional<App> app_;
};

}  // namespace patchlab::viewer
