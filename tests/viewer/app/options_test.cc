#include "viewer/app/options.h"

#include <gtest/gtest.h>

namespace patchlab::viewer {
namespace {

std::variant<ViewerOptions, Exit> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "patchlab-viewer");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Options, AreReadAsTheContractSays) {
  const auto parsed =
      parse({"a.pcd", "b.patchlab", "--headless", "--screenshot", "out.png", "--size", "800x600", "--scale",
             "2", "--theme", "light", "--replay", "log", "--export", "ply=p.ply"});
  const ViewerOptions* options = std::get_if<ViewerOptions>(&parsed);
  ASSERT_TRUE(options) << std::get<Exit>(parsed).text;
  EXPECT_EQ(options->files, (std::vector<std::filesystem::path>{"a.pcd", "b.patchlab"}));
  EXPECT_EQ(options->screenshot, "out.png");
  EXPECT_EQ(options->width, 800);
  EXPECT_EQ(options->height, 600);
  EXPECT_EQ(options->scale, 2.0f);
  EXPECT_EQ(options->theme, ThemeChoice::light);
  ASSERT_EQ(options->exports.size(), 1u);
  EXPECT_EQ(options->exports[0].format, "ply");
}

TEST(Options, AnExportTakesOneValueSoThatAScanMayFollowIt) {
  const auto parsed =
      parse({"--headless", "--export", "ply=a.ply", "scan.pcd", "--export", "patch_set=a.json", "more.pcd"});
  const ViewerOptions* options = std::get_if<ViewerOptions>(&parsed);
  ASSERT_TRUE(options) << std::get<Exit>(parsed).text;
  EXPECT_EQ(options->files, (std::vector<std::filesystem::path>{"scan.pcd", "more.pcd"}));
  ASSERT_EQ(options->exports.size(), 2u);
  EXPECT_EQ(options->exports[1].file, "a.json");
}

TEST(Options, WrongUsageIsTwoWithASentence) {
  const std::vector<std::vector<const char*>> wrong = {
      {"--size", "big"},   {"--size", "10x10", "--headless"}, {"--theme", "pink"},
      {"--scale", "0"},    {"--headless", "--export", "ply"}, {"--headless", "--export", "dance=x.dance"},
      {"--replay", "log"}, {"--export", "ply=x.ply"},         {"--no-such-option"}};
  for (const auto& arguments : wrong) {
    const auto parsed = parse(arguments);
    const Exit* exit = std::get_if<Exit>(&parsed);
    ASSERT_TRUE(exit) << arguments[0];
    EXPECT_EQ(exit->status, 2) << arguments[0];
    EXPECT_FALSE(exit->text.empty());
  }
}

TEST(Options, HelpAndVersionAreNoErrors) {
  for (const char* option : {"--help", "--version"}) {
    const auto parsed = parse({option});
    ASSERT_TRUE(std::get_if<Exit>(&parsed));
    EXPECT_EQ(std::get<Exit>(parsed).status, 0);
    EXPECT_FALSE(std::get<Exit>(parsed).text.empty());
  }
}

}  // namespace
}  // namespace patchlab::viewer
