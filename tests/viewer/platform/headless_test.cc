#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "viewer/platform/key.h"
#include "viewer/platform/platform.h"

namespace patchlab::viewer {
namespace {

constexpr const char* kEveryGlyph =
    "0123456789 +\u00b1\u2212\u00d7 \u00b7 \u00b2\u00b3\u207b\u00b9 \u03b1\u03ba\u03c3\u03c7\u03b3\u0394\u03a3 "
    "\u2190\u2191\u2192\u2193\u2194 \u2026 \u25b2\u25b6\u25bc\u25c0 \u25cf\u25cb\u25c6\u25c7\u25a0\u25a1 "
    "\u2713\u2717\u00b0\u2264\u2265\u2248\u221e\u221a\u2032\u201c\u201d\u2013\u2014\u00e4\u00df\u00e9\u00f1";

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
    EXPECT_GT(std::ranges::count_if(image.rgb, [](int v) { return v > 200; }), 1000 * scale);
    std::filesystem::create_directories("pictures");
    ASSERT_TRUE(write_png("pictures/fonts_" + std::to_string(static_cast<int>(100 * scale)) + ".png", image));
  }
}

TEST(Headless, EveryFontHasTheSignsAndEquallyWideDigits) {
  const auto platform = headless(64, 64);
  ASSERT_NE(platform, nullptr);
  frame(*platform, [] {});
  const Fonts& fonts = platform->fonts();
  for (ImFont* font : {fonts.body, fonts.small, fonts.heading, fonts.strong, fonts.title}) {
    for (const char* text = kEveryGlyph; *text != '\0';) {
      unsigned int character = 0;
      text += ImTextCharFromUtf8(&character, text, nullptr);
      EXPECT_NE(font->FindGlyphNoFallback(static_cast<ImWchar>(character)), nullptr) << std::hex << character;
    }
    for (char digit = '0'; digit <= '9'; ++digit)
      EXPECT_EQ(font->GetCharAdvance(static_cast<ImWchar>(digit)), font->GetCharAdvance('0'));
  }
}

TEST(Headless, ScaleChangesTheFontsBetweenFrames) {
  const auto platform = headless(64, 64);
  ASSERT_NE(platform, nullptr);
  frame(*platform, [] {});
  const float before = platform->fonts().body->FontSize;
  platform->set_scale(2.0f);
  frame(*platform, [&] { EXPECT_EQ(ImGui::GetFontSize(), 2.0f * before); });
  EXPECT_EQ(platform->scale(), 2.0f);
}

TEST(Headless, InputReachesWidgets) {
  const auto platform = headless(200, 100);
  ASSERT_NE(platform, nullptr);
  int clicks = 0;
  char name[32] = "";
  const auto show = [&](const Input& input) {
    platform->feed(input);
    frame(*platform, [&] {
      ImGui::SetCursorPos({10, 10});
      clicks += ImGui::Button("Fit", {50, 20});
      ImGui::SetCursorPos({10, 50});
      ImGui::InputText("##name", name, sizeof name);
    });
  };
  show({.mouse_x = 20, .mouse_y = 20});
  show({.mouse_x = 20, .mouse_y = 20, .buttons = {true, false, false}});
  EXPECT_EQ(clicks, 0);
  show({.mouse_x = 20, .mouse_y = 20});
  EXPECT_EQ(clicks, 1);
  show({.mouse_x = 20, .mouse_y = 60});
  show({.mouse_x = 20, .mouse_y = 60, .buttons = {true, false, false}});
  show({.mouse_x = 20, .mouse_y = 60});
  show({.mouse_x = 20, .mouse_y = 60, .text = "ball \u03c3"});
  show({.mouse_x = 20, .mouse_y = 60, .keys = {key::backspace}});
  show({.mouse_x = 20, .mouse_y = 60});
  EXPECT_STREQ(name, "ball ");
}

TEST(Headless, KeysAndModifiersAreSeen) {
  const auto platform = headless(64, 64);
  ASSERT_NE(platform, nullptr);
  int pressed = 0;
  const auto show = [&](const Input& input) {
    platform->feed(input);
    frame(*platform, [&] {
      pressed += ImGui::IsKeyPressed('Z', false) && ImGui::GetIO().KeyCtrl && ImGui::GetIO().KeyShift;
    });
  };
  show({});
  show({.keys = {'Z'}});
  EXPECT_EQ(pressed, 0) << "without modifiers";
  show({});
  show({.keys = {'Z', key::left_control, key::right_shift}});
  EXPECT_EQ(pressed, 1);
  show({.keys = {'Z', key::left_control, key::right_shift}});
  EXPECT_EQ(pressed, 1) << "held is not pressed again";
}

TEST(Headless, MouseOutsideIsNowhere) {
  const auto platform = headless(64, 64);
  ASSERT_NE(platform, nullptr);
  platform->feed({});
  frame(*platform, [] { EXPECT_FALSE(ImGui::IsMousePosValid()); });
  platform->feed({.mouse_x = 3, .mouse_y = 4, .wheel = 2});
  frame(*platform, [] { EXPECT_EQ(ImGui::GetIO().MouseWheel, 2.0f); });
  frame(*platform, [] { EXPECT_EQ(ImGui::GetIO().MouseWheel, 0.0f) << "the wheel is of one frame"; });
}

TEST(Headless, ResizeChangesThePicture) {
  const auto platform = headless(64, 48);
  ASSERT_NE(platform, nullptr);
  frame(*platform, [] {});
  platform->resize(120, 80);
  frame(*platform, [] { EXPECT_EQ(ImGui::GetIO().DisplaySize.x, 120.0f); });
  const Image image = platform->read_image();
  EXPECT_EQ(image.width, 120);
  EXPECT_EQ(image.height, 80);
  EXPECT_EQ(image.rgb.size(), 3u * 120 * 80);
}

TEST(Headless, SameFrameIsTheSameBytesOnANewPlatform) {
  std::vector<Image> images;
  for (int i = 0; i < 2; ++i) {
    const auto platform = headless(200, 100);
    ASSERT_NE(platform, nullptr);
    frame(*platform, [] { ImGui::TextUnformatted(kEveryGlyph); });
    images.push_back(platform->read_image());
  }
  EXPECT_EQ(images[0].rgb, images[1].rgb);
}

TEST(Headless, WritesNoFiles) {
  const auto platform = headless(64, 64);
  ASSERT_NE(platform, nullptr);
  EXPECT_EQ(ImGui::GetIO().IniFilename, nullptr);
  EXPECT_EQ(ImGui::GetIO().LogFilename, nullptr);
}

TEST(WritePng, RefusesAFolderThatIsNotThere) {
  const Result<void> written = write_png("no/such/folder/a.png", {1, 1, {1, 2, 3}});
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().code, ErrorCode::unwritable);
}

}  // namespace
}  // namespace patchlab::viewer
