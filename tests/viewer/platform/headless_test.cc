#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "engine/base/file.h"
#include "viewer/platform/platform.h"

namespace patchlab::viewer {
namespace {

constexpr const char* kEveryGlyph =
    "0123456789 +\u00b1\u2212\u00d7 \u00b7 \u00b2\u00b3\u207b\u00b9 "
    "\u03b1\u03ba\u03c3\u03c7\u03b3\u0394\u03a3 "
    "\u2190\u2191\u2192\u2193\u2194 \u2026 \u25b2\u25b6\u25bc\u25c0 \u25b4\u25b8\u25be\u25c2 "
    "\u25cf\u25cb\u25c6\u25c7\u25a0\u25a1 "
    "\u2713\u2717\u00b0\u2264\u2265\u2248\u221e\u221a\u2032\u201c\u201d\u2013\u2014\u00e4\u00df\u00e9\u00f1 "
    "\u0416";

std::unique_ptr<Platform> headless(int width, int height, float scale = 1.0f) {
  Result<std::unique_ptr<Platform>> made =
      make_platform({.title = "test", .width = width, .height = height, .headless = true, .scale = scale});
  if (!made) ADD_FAILURE() << made.error().message;
  return made ? std::move(*made) : nullptr;
}

// One frame holding a borderless window over everything, which `contents` fills.
template <class F>
void frame(Platform& platform, F contents) {
  platform.begin_frame();
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::Begin("all", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
  contents();
  ImGui::End();
  platform.end_frame();
}

TEST(Headless, TextIsDrawnAtEveryScale) {
  for (const float scale : {1.0f, 1.5f, 2.0f}) {
    const auto platform = headless(static_cast<int>(560 * scale), static_cast<int>(140 * scale), scale);
    ASSERT_NE(platform, nullptr);
    const Fonts& fonts = platform->fonts();
    frame(*platform, [&] {
      for (ImFont* font : {fonts.body, fonts.small, fonts.heading, fonts.strong, fonts.title}) {
        ImGui::PushFont(font);
        ImGui::TextUnformatted(kEveryGlyph);
        ImGui::PopFont();
      }
    });
    const Image image = platform->read_image();
    EXPECT_GT(std::ranges::count_if(image.rgb, [](int v) { return v > 200; }), 1000);
    ASSERT_TRUE(write_png("fonts_" + std::to_string(scale).substr(0, 3) + ".png", image));
  }
}

}  // namespace
}  // namespace patchlab::viewer
