#include <algorithm>
#include <limits>

#include "engine/project/command.h"
#include "engine/project/map_commands.h"
#include "engine/project/parts_json.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t largest_id = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t most_steps = 1000;  // of one reshape

struct ModeName {
  SelectMode mode;
  std::string_view name;
};
constexpr ModeName modes[] = {{SelectMode::set, "set"},
                              {SelectMode::add, "add"},
                              {SelectMode::subtract, "subtract"},
                              {SelectMode::intersect, "intersect"}};

std::optional<SelectMode> mode_from_name(std::string_view name) {
  const auto* row = std::ranges::find(modes, name, &ModeName::name);
  return row == std::end(modes) ? std::nullopt : std::optional(row->mode);
}

struct ReshapingName {
  Reshaping how;
  std::string_view name;
};
constexpr ReshapingName reshapings[] = {{Reshaping::invert, "invert"},
                                        {Reshaping::grow, "grow"},
                                        {Reshaping::shrink, "shrink"},
                                        {Reshaping::linked, "linked"}};

std::optional<Reshaping> reshaping_from_name(std::string_view name) {
  const auto* row = std::ranges::find(reshapings, name, &ReshapingName::name);
  return row == std::end(reshapings) ? std::nullopt : std::optional(row->how);
}

std::optional<bool> sensor_from_name(std::string_view name) {
  return name == "sensor" ? std::optional(true) : std::nullopt;
}

// fx fy cx cy; the size of the pictures was checked when the intrinsics were given.
Intrinsics read_intrinsics(const JsonPlace& place) {
  const Eigen::VectorXd n = place.numbers(4);
  must(n[0] > 0.0 && n[1] > 0.0, place, "has a focal length that is not positive");
  return {.fx = n[0], .fy = n[1], .cx = n[2], .cy = n[3]};
}

double read_depth_scale(const JsonPlace& place) {
  const double scale = place.number();
  must(scale > 0.0, place, "must be positive");
  return scale;
}

std::uint32_t read_id(const JsonPlace& place) {
  return static_cast<std::uint32_t>(place.whole_number(largest_id));
}
std::vector<std::uint32_t> read_ids(const JsonPlace& place) {
  std::vector<std::uint32_t> ids;
  for (const JsonPlace& item : place.items()) ids.push_back(read_id(item));
  return ids;
}

std::vector<Eigen::Vector2d> read_polygon(const JsonPlace& place) {
  std::vector<Eigen::Vector2d> polygon;
  for (const JsonPlace& item : place.items()) polygon.emplace_back(item.numbers(2));
  must(polygon.size() >= 3, place, "must have three vertices or more");
  return polygon;
}

void read(const JsonPlace& place, OpenScan& open) {
  place.only(
      {"do", "id", "file", "sha256", "noise", "points_in", "viewpoint", "unit", "intrinsics", "depth_scale"});
  open.id = place["id"].text();
  open.file = place["file"].text();
  may(place, "sha256", open.sha256, &JsonPlace::text);
  may(place, "noise", open.noise, &JsonPlace::text);
  may_name(place, "points_in", open.points_in_sensor_frame, sensor_from_name);
  may(place, "viewpoint", open.viewpoint, read_position);
  may_name(place, "unit", open.unit, length_unit_from_name);
  may(place, "intrinsics", open.intrinsics, read_intrinsics);
  may(place, "depth_scale", open.depth_scale, read_depth_scale);
}

ordered_json write(const OpenScan& open) {
  ordered_json object = {{"do", "open_scan"}, {"id", open.id}, {"file", open.file}};
  if (!open.sha256.empty()) object["sha256"] = open.sha256;
  if (!open.noise.empty()) object["noise"] = open.noise;
  if (open.points_in_sensor_frame) object["points_in"] = "sensor";
  if (open.viewpoint) object["viewpoint"] = list(*open.viewpoint);
  object["unit"] = name(open.unit);
  if (open.intrinsics) {
    const Intrinsics& camera = *open.intrinsics;
    object["intrinsics"] = {camera.fx, camera.fy, camera.cx, camera.cy};
  }
  if (open.depth_scale > 0.0) object["depth_scale"] = open.depth_scale;
  return object;
}

void read(const JsonPlace& place, SetNoise& set) {
  place.only({"do", "scan", "noise"});
  set = {place["scan"].text(), place["noise"].text()};
}

ordered_json write(const SetNoise& set) {
  return {{"do", "set_noise"}, {"scan", set.scan}, {"noise", set.noise}};
}

void read(const JsonPlace& place, Select& select) {
  place.only(
      {"do", "region", "scan", "mode", "label", "indices", "flood", "polygon", "camera", "visible_only"});
  select.region = place["region"].text();
  select.scan = place["scan"].text();
  may_name(place, "mode", select.mode, mode_from_name);
  may(place, "label", select.label, read_id);
  may(place, "indices", select.indices, read_ids);
  may(place, "flood", select.flood, read_position);
  may(place, "polygon", select.polygon, read_polygon);
  const int ways = int{select.label.has_value()} + int{select.indices.has_value()} +
                   int{select.flood.has_value()} + int{!select.polygon.empty()};
  must(ways == 1, place, "needs one of the members polygon, flood, label and indices");
  if (select.polygon.empty()) return;
  select.camera = read_camera(place["camera"]);
  may(place, "visible_only", select.visible_only, &JsonPlace::boolean);
}

ordered_json write(const Select& select) {
  ordered_json object = {{"do", "select"}, {"region", select.region}, {"scan", select.scan}};
  object["mode"] = std::ranges::find(modes, select.mode, &ModeName::mode)->name;
  if (select.label) {
    object["label"] = *select.label;
  } else if (select.indices) {
    object["indices"] = *select.indices;
  } else if (select.flood) {
    object["flood"] = list(*select.flood);
  } else {
    ordered_json& polygon = object["polygon"] = ordered_json::array();
    for (const Eigen::Vector2d& vertex : select.polygon) polygon.push_back(list(vertex));
    object["camera"] = write(select.camera);
    object["visible_only"] = select.visible_only;
  }
  return object;
}

int read_steps(const JsonPlace& place) {
  const std::uint64_t steps = place.whole_number(most_steps);
  must(steps >= 1, place, "must be at least 1");
  return static_cast<int>(steps);
}

void read(const JsonPlace& place, Reshape& reshape) {
  place.only({"do", "region", "how", "steps"});
  reshape.region = place["region"].text();
  (void)place["how"].text();
  may_name(place, "how", reshape.how, reshaping_from_name);
  may(place, "steps", reshape.steps, read_steps);
}

ordered_json write(const Reshape& reshape) {
  ordered_json object = {{"do", "reshape"}, {"region", reshape.region}};
  object["how"] = std::ranges::find(reshapings, reshape.how, &ReshapingName::how)->name;
  if (reshape.steps != 1) object["steps"] = reshape.steps;
  return object;
}

void read(const JsonPlace& place, Fit& fit) {
  place.only({"do", "patch", "region", "options", "result_sha256"});
  fit.patch = place["patch"].text();
  fit.region = place["region"].text();
  may(place, "options", fit.options, read_options);
  may(place, "result_sha256", fit.result_sha256, &JsonPlace::text);
}

ordered_json write(const Fit& fit) {
  ordered_json object = {
      {"do", "fit"}, {"patch", fit.patch}, {"region", fit.region}, {"options", write(fit.options)}};
  if (!fit.result_sha256.empty()) object["result_sha256"] = fit.result_sha256;
  return object;
}

void read(const JsonPlace& place, Rename& rename) {
  place.only({"do", "target", "name"});
  rename = {place["target"].text(), place["name"].text()};
}

ordered_json write(const Rename& rename) {
  return {{"do", "rename"}, {"target", rename.target}, {"name", rename.name}};
}

void read(const JsonPlace& place, SetColour& set) {
  place.only({"do", "target", "colour"});
  set.target = place["target"].text();
  const std::optional<JsonPlace> colour = place.find("colour");
  if (!colour) return;
  set.colour = colour_from_text(colour->text());
  if (!set.colour) colour->fail("is no colour such as #e69f00");
}

ordered_json write(const SetColour& set) {
  ordered_json object = {{"do", "set_colour"}, {"target", set.target}};
  if (set.colour) object["colour"] = to_text(*set.colour);
  return object;
}

void read(const JsonPlace& place, Delete& erase) {
  place.only({"do", "target"});
  erase.target = place["target"].text();
}

ordered_json write(const Delete& erase) { return {{"do", "delete"}, {"target", erase.target}}; }

void read(const JsonPlace& place, Show& show) {
  place.only({"do", "target", "visible"});
  show = {place["target"].text(), place["visible"].boolean()};
}

ordered_json write(const Show& show) {
  return {{"do", "show"}, {"target", show.target}, {"visible", show.visible}};
}

void read(const JsonPlace& place, Undo&) { place.only({"do"}); }
ordered_json write(const Undo&) { return ordered_json::object({{"do", "undo"}}); }

void read(const JsonPlace& place, Redo&) { place.only({"do"}); }
ordered_json write(const Redo&) { return ordered_json::object({{"do", "redo"}}); }

template <class T>
Command read_command(const JsonPlace& place) {
  T command;
  read(place, command);
  return command;
}

struct Verb {
  std::string_view name;
  Command (*read)(const JsonPlace& place);
};
constexpr Verb verbs[] = {
    {"open_scan", read_command<OpenScan>},
    {"set_noise", read_command<SetNoise>},
    {"select", read_command<Select>},
    {"reshape", read_command<Reshape>},
    {"fit", read_command<Fit>},
    {"open_map", read_command<OpenMap>},
    {"open_robot", read_command<OpenRobot>},
    {"set_joint", read_command<SetJoint>},
    {"place", read_command<Place>},
    {"merge", read_command<Merge>},
    {"rename", read_command<Rename>},
    {"set_colour", read_command<SetColour>},
    {"delete", read_command<Delete>},
    {"show", read_command<Show>},
    {"undo", read_command<Undo>},
    {"redo", read_command<Redo>},
};

}  // namespace

ordered_json to_json(const Command& command) {
  return std::visit([](const auto& one) { return write(one); }, command);
}

Result<Command> command_from_json(const nlohmann::json& json, const std::string& name) {
  std::optional<Error> error;
  const JsonPlace place = JsonPlace(json, name, error).called("the command");
  const JsonPlace verb_place = place["do"];
  const std::string verb_name = verb_place.text();
  const auto* verb = std::ranges::find(verbs, verb_name, &Verb::name);
  if (verb == std::end(verbs)) {
    verb_place.fail("'" + verb_name + "' is not known");
    return *error;
  }
  Command command = verb->read(place.called(verb_name));
  if (error) return *error;
  return command;
}

}  // namespace patchlab
