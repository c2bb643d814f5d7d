// What the window remembers from one run to the next, nothing of it of a document:
// $XDG_CONFIG_HOME/patchlab/viewer.json, or ~/.config/patchlab/viewer.json. Runs without a user take no
// notice of it, so that their pictures depend on nothing.
#pragma once

#include <filesystem>

#include "engine/base/result.h"
#include "viewer/panel/view_state.h"

namespace patchlab::viewer {

struct Settings {
  ThemeChoice theme = ThemeChoice::dark;
  float scale = 0.0f;  // of the interface; 0: from the monitor
  float point_size = 2.0f;
  bool visible_only = true, robust = true, perspective = true;
  Layers layers;
  ColourMap map = ColourMap::viridis;
  PanelWidths widths;
  bool operator==(const Settings&) const = default;
};

std::filesystem::path default_settings_file();
// What the file does not say, or says wrongly, is as it is by default; so is all of it where there is none.
Settings read_settings(const std::filesystem::path& file);
// Makes the folder. unwritable error.
Result<void> write_settings(const std::filesystem::path& file, const Settings& settings);

}  // namespace patchlab::viewer
