// The command line of patchlab-viewer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "viewer/panel/view_state.h"

namespace patchlab::viewer {

struct ViewerOptions {
  std::vector<std::filesystem::path> files;  // scans and journals
  std::optional<std::filesystem::path> replay, screenshot;
  int width = 1440, height = 900;
  bool headless = false;
  bool view_alone = false, transparent = false;  // of the picture
  float scale = 0.0f;                            // 0: from the monitor
  std::optional<ThemeChoice> theme;              // none: as it was left, or dark
  std::vector<ExportRequest> exports;
};

// What to do, or text to print and the status to exit with (help, version, wrong usage).
struct Exit {
  int status = 0;
  std::string text;
};
std::variant<ViewerOptions, Exit> parse_options(int argc, const char* const* argv);

}  // namespace patchlab::viewer
