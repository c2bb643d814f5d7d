#include "viewer/app/options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "engine/export/export.h"

namespace patchlab::viewer {

namespace {

bool whole_number(std::string_view text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::string parse_size(const std::string& text, ViewerOptions& options) {
  const std::size_t x = text.find('x');
  const bool good =
      x != std::string::npos && whole_number(std::string_view(text).substr(0, x), options.width) &&
      whole_number(std::string_view(text).substr(x + 1), options.height) && options.width >= 320 &&
      options.height >= 240 && options.width <= 16384 && options.height <= 16384;
  return good ? "" : "--size " + text + ": give width and height in pixels, from 320x240 to 16384x16384.";
}

std::string parse_export(const std::string& text, ViewerOptions& options) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) {
    return "--export " + text + ": give a format and a file, such as ply=patches.ply.";
  }
  const std::string format = text.substr(0, equals);
  if (const auto known = export_format(format); !known) return known.error().message;
  options.exports.push_back({format, text.substr(equals + 1)});
  return {};
}

std::string check_together(const ViewerOptions& options) {
  if (options.replay && !options.headless) {
    return "--replay needs --headless: a window listens to its user alone.";
  }
  if (!options.exports.empty() && !options.headless) {
    return "--export needs --headless: in the window, use File > Export patches.";
  }
  if ((options.view_alone || options.transparent) && !options.screenshot) {
    return "--view-alone and --transparent say how a picture is made: add --screenshot FILE.png.";
  }
  if (options.transparent && !options.view_alone) {
    return "--transparent needs --view-alone: panels have a ground of their own.";
  }
  return {};
}

}  // namespace

std::variant<ViewerOptions, Exit> parse_options(int argc, const char* const* argv) {
  ViewerOptions options;
  std::string size = "1440x900", theme_name, replay, screenshot;
  std::vector<std::string> files, exports;
  CLI::App cli("Bounded curved patches with honest uncertainty, from range scans.", "patchlab-viewer");
  cli.add_option("files", files, "scans and journals (.patchlab) to open")->type_name("SCAN|JOURNAL");
  cli.add_flag("--headless", options.headless, "draw without a window or a display");
  cli.add_option("--screenshot", screenshot,
                 "write a picture of the program when everything is there, then quit")
      ->type_name("FILE.png");
  cli.add_flag("--view-alone", options.view_alone, "picture the view without the panels around it");
  cli.add_flag("--transparent", options.transparent, "picture without a ground (with --view-alone)");
  cli.add_option("--replay", replay, "do what a log of mouse and keys says (with --headless)")
      ->type_name("LOG");
  cli.add_option("--size", size, "of the window or picture in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  cli.add_option("--scale", options.scale, "of the interface; 1 is for 96 dots an inch")
      ->check(CLI::Range(0.5f, 4.0f));
  cli.add_option("--theme", theme_name, "dark or light; in a window as it was left, where this is not given")
      ->check(CLI::IsMember({"dark", "light"}));
  cli.add_option("--export", exports, "write the patches at the end (with --headless); may be repeated")
      ->type_name("FORMAT=FILE")
      ->allow_extra_args(false);
  cli.set_version_flag("--version", std::string("patchlab-viewer ") + PATCHLAB_VERSION);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Exit{0, cli.help()};
  } catch (const CLI::CallForVersion& version) {
    return Exit{0, std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    return Exit{2, std::string(error.what()) + "\nRun patchlab-viewer --help for the options.\n"};
  }
  options.files.assign(files.begin(), files.end());
  if (!replay.empty()) options.replay = replay;
  if (!screenshot.empty()) options.screenshot = screenshot;
  if (!theme_name.empty()) options.theme = theme_name == "light" ? ThemeChoice::light : ThemeChoice::dark;
  std::string wrong = parse_size(size, options);
  for (const std::string& text : exports) {
    if (wrong.empty()) wrong = parse_export(text, options);
  }
  if (wrong.empty()) wrong = check_together(options);
  if (!wrong.empty()) return Exit{2, wrong + "\n"};
  return options;
}

}  // namespace patchlab::viewer
