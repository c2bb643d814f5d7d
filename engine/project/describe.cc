#include <algorithm>
#include <cstdio>
#include <numbers>

#include "engine/project/command.h"

namespace patchlab {
namespace {

std::string with_commas(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

std::string points(std::size_t count) {
  return " · " + with_commas(count) + (count == 1 ? " point" : " points");
}

// What the user calls it: its name, or its id where it is gone.
std::string called(const Document& document, const std::string& id) {
  if (const ScanEntry* scan = find_scan(document, id)) return scan->name;
  if (const RegionEntry* region = find_region(document, id)) return region->name;
  if (const PatchEntry* patch = find_patch(document, id)) return patch->name;
  if (const MapEntry* map = find_map(document, id)) return map->name;
  if (const RobotEntry* robot = find_robot(document, id)) return robot->name;
  return id;
}

std::string spell(const OpenScan& open, const Document& after) {
  return "open " + called(after, open.id) + points(find_scan(after, open.id)->scan->finite_count);
}

std::string spell(const SetNoise& set, const Document& after) {
  return "noise of " + called(after, set.scan) + " · " + find_scan(after, set.scan)->noise.specification;
}

std::string spell(const Select& select, const Document& after) {
  const std::string how = select.label     ? "label " + std::to_string(*select.label)
                          : select.indices ? "points"
                          : select.flood   ? "surface"
                                           : "lasso";
  const std::string what = select.mode == SelectMode::set        ? " "
                           : select.mode == SelectMode::add      ? " added to "
                           : select.mode == SelectMode::subtract ? " taken from "
                                                                 : " within ";
  const RegionEntry& region = *find_region(after, select.region);
  return how + what + region.name + points(region.points->size());
}

std::string spell(const Reshape& reshape, const Document& after) {
  constexpr const char* words[] = {"invert ", "grow ", "shrink ", "all linked to "};
  const RegionEntry& region = *find_region(after, reshape.region);
  return words[static_cast<std::size_t>(reshape.how)] + region.name + points(region.points->size());
}

std::string spell(const Fit& fit, const Document& after) {
  const FitResult& result = *find_patch(after, fit.patch)->fit;
  std::string surface(name(result.patch.type->surface));
  for (char& letter : surface) {
    if (letter == '_') letter = ' ';
  }
  return "fit " + called(after, fit.patch) + " · " + surface + points(result.report.points);
}

std::string patches(std::size_t count) {
  return " · " + with_commas(count) + (count == 1 ? " patch" : " patches");
}

std::string spell(const OpenMap& open, const Document& after) {
  return "open " + called(after, open.id) + patches(find_map(after, open.id)->map->patches.size());
}

std::string spell(const OpenRobot& open, const Document& after) {
  return "open " + called(after, open.id) + patches(find_robot(after, open.id)->model->patches.size());
}

std::string spell(const SetJoint& set, const Document& after) {
  const RobotEntry* robot = find_robot(after, set.robot);
  const std::vector<RobotJoint>& joints = robot->model->robot.joints;
  const auto joint = std::ranges::find(joints, set.joint, &RobotJoint::name);
  const bool slides = joint != joints.end() && joint->kind == JointKind::sliding;
  char value[32];
  std::snprintf(value, sizeof value, slides ? "%.1f mm" : "%.1f\u00b0",
                slides ? 1e3 * set.value : set.value * 180.0 / std::numbers::pi);
  return "move " + set.joint + " · " + value;
}

std::string spell(const Place& place, const Document&) { return "place " + place.frame + " in " + place.in; }

std::string spell(const Merge& merge, const Document& after) {
  return "merge " + called(after, merge.view) + " into " + called(after, merge.map) +
         patches(find_map(after, merge.map)->map->patches.size());
}

std::string spell(const Rename& rename, const Document&) {
  return "rename " + rename.target + " to " + rename.name;
}
std::string spell(const SetColour& set, const Document& after) {
  return set.colour ? "colour " + called(after, set.target) + " " + to_text(*set.colour)
                    : "colour " + called(after, set.target) + " automatically";
}
std::string spell(const Delete& erase, const Document&) { return "delete " + erase.target; }
std::string spell(const Show& show, const Document& after) {
  return (show.visible ? "show " : "hide ") + called(after, show.target);
}
std::string spell(const Undo&, const Document&) { return "undo"; }
std::string spell(const Redo&, const Document&) { return "redo"; }

}  // namespace

std::string describe(const Command& command, const Document& after) {
  return std::visit([&](const auto& one) { return spell(one, after); }, command);
}

}  // namespace patchlab
