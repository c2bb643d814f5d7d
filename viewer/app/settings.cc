#include "viewer/app/settings.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"

namespace patchlab::viewer {

namespace fs = std::filesystem;

namespace {

using nlohmann::ordered_json;

template <class Owner>
struct Switch {
  const char* name;
  bool Owner::*value;
};
constexpr Switch<Settings> kSwitches[] = {{"visible_only", &Settings::visible_only},
                                          {"reject_outliers", &Settings::robust},
                                          {"perspective", &Settings::perspective}};
constexpr Switch<Layers> kLayerSwitches[] = {
    {"surface", &Layers::surface}, {"ellipsoid", &Layers::ellipsoid}, {"cone", &Layers::cone},
    {"band", &Layers::band},       {"axes", &Layers::axes},           {"offsets", &Layers::offsets},
    {"points", &Layers::points},   {"grid", &Layers::grid},           {"names", &Layers::names}};

template <class Owner, std::size_t n>
void read_switches(const ordered_json& object, const Switch<Owner> (&switches)[n], Owner& owner) {
  for (const Switch<Owner>& one : switches) {
    const auto found = object.find(one.name);
    if (found != object.end() && found->is_boolean()) owner.*one.value = found->template get<bool>();
  }
}

void read_number(const ordered_json& object, const char* name, float least, float largest, float& number) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number()) return;
  const float said = found->get<float>();
  if (said >= least && said <= largest) number = said;
}

}  // namespace

fs::path default_settings_file() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  const fs::path folder = config && *config ? fs::path(config) : fs::path(home ? home : ".") / ".config";
  return folder / "patchlab" / "viewer.json";
}

Settings read_settings(const fs::path& file) {
  Settings settings;
  const Result<Bytes> bytes = read_file(file);
  if (!bytes) return settings;
  const ordered_json object = ordered_json::parse(as_text(*bytes), nullptr, false);
  if (!object.is_object()) return settings;
  if (object.value("theme", ordered_json()) == "light") settings.theme = ThemeChoice::light;
  read_number(object, "scale", 0.5f, 4.0f, settings.scale);
  read_number(object, "point_size", 1.0f, 12.0f, settings.point_size);
  if (object.value("colour_map", ordered_json()) == "cividis") settings.map = ColourMap::cividis;
  read_number(object, "tree_width", 160.0f, 720.0f, settings.widths.tree);
  read_number(object, "inspector_width", 160.0f, 720.0f, settings.widths.inspector);
  read_switches(object, kSwitches, settings);
  if (const auto layers = object.find("layers"); layers != object.end() && layers->is_object()) {
    read_switches(*layers, kLayerSwitches, settings.layers);
  }
  return settings;
}

Result<void> write_settings(const fs::path& file, const Settings& settings) {
  ordered_json object = {{"theme", settings.theme == ThemeChoice::light ? "light" : "dark"},
                         {"scale", settings.scale},
                         {"point_size", settings.point_size},
                         {"colour_map", settings.map == ColourMap::cividis ? "cividis" : "viridis"},
                         {"tree_width", settings.widths.tree},
                         {"inspector_width", settings.widths.inspector}};
  for (const auto& one : kSwitches) object[one.name] = settings.*one.value;
  for (const auto& one : kLayerSwitches) object["layers"][one.name] = settings.layers.*one.value;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) {
    return Error{ErrorCode::unwritable, "The folder for settings " + file.parent_path().string() +
                                            " cannot be made: " + error.message() + "."};
  }
  return write_file(file, object.dump(2) + "\n");
}

}  // namespace patchlab::viewer
