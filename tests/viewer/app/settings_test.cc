#include "viewer/app/settings.h"

#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "tests/viewer/app/ball_scan.h"

namespace patchlab::viewer {
namespace {

class SettingsTest : public testing::Test {
 protected:
  Settings read_back(const std::string& text) const {
    EXPECT_TRUE(write_file(folder_.path() / "viewer.json", text).ok());
    return read_settings(folder_.path() / "viewer.json");
  }
  TestFolder folder_;
};

TEST_F(SettingsTest, ComeBackAsTheyWereWritten) {
  Settings settings;
  settings.theme = ThemeChoice::light;
  settings.scale = 1.5f;
  settings.point_size = 3.5f;
  settings.robust = false;
  settings.layers.cone = false;
  settings.layers.offsets = true;
  settings.map = ColourMap::cividis;
  settings.widths = {200.0f, 500.0f};
  const std::filesystem::path file = folder_.path() / "made" / "patchlab" / "viewer.json";
  ASSERT_TRUE(write_settings(file, settings).ok());
  EXPECT_EQ(read_settings(file), settings);
}

TEST_F(SettingsTest, AreTheDefaultsWhereThereIsNoFileOrNoneThatCanBeRead) {
  EXPECT_EQ(read_settings(folder_.path() / "none.json"), Settings());
  for (const char* text : {"", "{", "[1, 2]", "7", "{\"theme\": 7, \"scale\": \"large\", \"layers\": true}",
                           "{\"scale\": 1000, \"point_size\": -1, \"robust\": null}"}) {
    EXPECT_EQ(read_back(text), Settings()) << text;
  }
}

TEST_F(SettingsTest, KeepWhatAFileSaysRightlyBesideWhatItSaysWrongly) {
  const Settings settings =
      read_back("{\"theme\": \"light\", \"scale\": [], \"layers\": {\"band\": false, \"cone\": 3}}");
  EXPECT_EQ(settings.theme, ThemeChoice::light);
  EXPECT_EQ(settings.scale, 0.0f);
  EXPECT_FALSE(settings.layers.band);
  EXPECT_TRUE(settings.layers.cone);
}

TEST_F(SettingsTest, ThatCannotBeWrittenAreAnErrorOfOneSentence) {
  ASSERT_TRUE(write_file(folder_.path() / "file", "").ok());
  EXPECT_EQ(write_settings(folder_.path() / "file" / "viewer.json", {}).error().code, ErrorCode::unwritable);
}

}  // namespace
}  // namespace patchlab::viewer
