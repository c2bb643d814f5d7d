#include "engine/project/placed.h"

#include <algorithm>

namespace patchlab {
namespace {

Error unjoined(const std::string& to, const std::string& from) {
  return {ErrorCode::usage,
          "Nothing says where frame \"" + from + "\" stands in \"" + to + "\": place one in the other."};
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

}  // namespace

std::string shown_frame(const Document& document) {
  if (!document.scans.empty()) return frame_of(document.scans.front());
  if (!document.maps.empty()) return document.maps.front().map->frame;
  return document.robots.empty() ? std::string() : document.robots.front().frame;
}

UpDirection up_in(const std::string& frame) {
  if (frame == "sensor") return {-Vector3d::UnitY(), "\u2212y"};
  return {Vector3d::UnitZ(), "+z"};
}

std::vector<std::string> frame_names(const Document& document) {
  std::vector<std::string> names;
  for (const ScanEntry& scan : document.scans) add_once(names, frame_of(scan));
  for (const MapEntry& map : document.maps) add_once(names, map.map->frame);
  for (const RobotEntry& robot : document.robots) add_once(names, robot.frame);
  for (const FrameEntry& frame : document.frames) {
    add_once(names, frame.in);
    add_once(names, frame.name);
  }
  return names;
}

FrameTree frame_tree(const Document& document) {
  FrameTree tree;
  for (const FrameEntry& frame : document.frames) (void)tree.add(frame.name, frame.in, frame.pose);
  return tree;
}

Result<UncertainPose> pose_between(const Document& document, const std::string& to, const std::string& from) {
  if (to == from) return UncertainPose{};
  const FrameTree tree = frame_tree(document);
  if (!tree.has(to) || !tree.has(from)) return unjoined(to, from);
  Result<UncertainPose> pose = tree.pose(to, from);
  return pose ? pose : Result<UncertainPose>(unjoined(to, from));
}

UncertainPose standing(const Document& document, const std::string& frame) {
  const Result<UncertainPose> pose = pose_between(document, shown_frame(document), frame);
  return pose ? *pose : UncertainPose{};
}

std::vector<PlacedPatch> placed_patches(const Document& document) {
  std::vector<PlacedPatch> placed;
  for (const PatchEntry& entry : document.patches) {
    const ScanEntry* scan = find_scan(document, entry.scan);
    if (!entry.fit) continue;
    const std::string frame = scan ? frame_of(*scan) : std::string();
    placed.push_back({entry.id, entry.name, PatchOf::scan, entry.scan, frame, entry.fit->patch});
  }
  for (const MapEntry& entry : document.maps) {
    for (std::size_t i = 0; i < entry.map->patches.size(); ++i) {
      const MapPatch& patch = entry.map->patches[i];
      const std::string& name = entry.set->patches[i].name;
      placed.push_back({entry.id + "/" + patch.id, name.empty() ? patch.id : name, PatchOf::map, entry.id,
                        entry.map->frame, patch.patch});
    }
  }
  for (const RobotEntry& entry : document.robots) {
    for (const RobotPatch& patch : entry.model->patches)
      placed.push_back(
          {entry.id + "/" + patch.id, patch.id, PatchOf::robot, entry.id, patch.link, patch.patch});
  }
  return placed;
}

std::optional<PlacedPatch> find_placed(const Document& document, const std::string& id) {
  std::vector<PlacedPatch> placed = placed_patches(document);
  const auto found = std::ranges::find(placed, id, &PlacedPatch::id);
  return found == placed.end() ? std::nullopt : std::optional(std::move(*found));
}

bool is_visible(const Document& document, const PlacedPatch& placed) {
  switch (placed.of) {
    case PatchOf::scan:
      return find_patch(document, placed.id)->visible;
    case PatchOf::map:
      return find_map(document, placed.owner)->visible;
    case PatchOf::robot:
      return find_robot(document, placed.owner)->visible;
  }
  return false;
}

Result<PosedRobot> posed(const RobotEntry& entry) {
  return PosedRobot::make(entry.model->robot, entry.joints, entry.model->tolerance);
}

namespace {

// With the frame that it then stands in: of a robot, the one that its base is fixed in.
struct Rooted {
  Patch patch;
  std::string frame;
};
Result<Rooted> rooted(const Document& document, const PlacedPatch& placed) {
  if (placed.of != PatchOf::robot) return Rooted{placed.patch, placed.frame};
  const RobotEntry& entry = *find_robot(document, placed.owner);
  const Result<PosedRobot> robot = posed(entry);
  if (!robot) return robot.error();
  const Result<UncertainPose> base_from_link = robot->pose(entry.model->robot.base, placed.frame);
  if (!base_from_link) return base_from_link.error();
  return Rooted{transform(*base_from_link, placed.patch), entry.frame};
}

Result<std::array<Patch, 2>> on_one_robot(const Document& document, const PlacedPatch& a,
                                          const PlacedPatch& b) {
  const Result<PosedRobot> robot = posed(*find_robot(document, a.owner));
  if (!robot) return robot.error();
  const Result<UncertainPose> a_from_b = robot->pose(a.frame, b.frame);
  if (!a_from_b) return a_from_b.error();
  return std::array<Patch, 2>{a.patch, transform(*a_from_b, b.patch)};
}

Error no_patch(const std::string& id) { return {ErrorCode::usage, "There is no patch '" + id + "'."}; }

}  // namespace

Result<Patch> as_shown(const Document& document, const PlacedPatch& placed) {
  if (placed.of == PatchOf::scan) return placed.patch;
  const Result<Rooted> in_frame = rooted(document, placed);
  if (!in_frame) return in_frame.error();
  return transform(standing(document, in_frame->frame), in_frame->patch);
}

Result<std::array<Patch, 2>> related(const Document& document, const std::string& id_a,
                                     const std::string& id_b) {
  const auto a = find_placed(document, id_a), b = find_placed(document, id_b);
  if (!a) return no_patch(id_a);
  if (!b) return no_patch(id_b);
  if (a->of == PatchOf::robot && b->of == PatchOf::robot && a->owner == b->owner)
    return on_one_robot(document, *a, *b);
  const Result<Rooted> root_a = rooted(document, *a), root_b = rooted(document, *b);
  if (!root_a) return root_a.error();
  if (!root_b) return root_b.error();
  const Result<UncertainPose> a_from_b = pose_between(document, root_a->frame, root_b->frame);
  if (!a_from_b) return a_from_b.error();
  return std::array<Patch, 2>{root_a->patch, transform(*a_from_b, root_b->patch)};
}

Result<Relation> relate(const Document& document, const std::string& a, const std::string& b) {
  const Result<std::array<Patch, 2>> two = related(document, a, b);
  if (!two) return two.error();
  const auto& [patch_a, patch_b] = *two;
  const auto of_robot = [&](const std::string& id) {
    return find_placed(document, id)->of == PatchOf::robot;
  };
  const bool b_stands = of_robot(b) && !of_robot(a);
  return Relation{centre_distance(patch_a, patch_b), normal_angle(patch_a, patch_b),
                  b_stands ? foot_fit(patch_b, patch_a) : foot_fit(patch_a, patch_b)};
}

Result<Slope> slope(const Document& document, const std::string& id, const Vector3d& up, double limit) {
  const auto placed = find_placed(document, id);
  if (!placed) return no_patch(id);
  const Result<Patch> patch = as_shown(document, *placed);
  if (!patch) return patch.error();
  return Slope{tilt(*patch, up), tilt_exceeds(*patch, up, limit)};
}

PatchSet set_to_export(const Document& document, const std::string& chosen, const std::string& journal) {
  for (const MapEntry& map : document.maps) {
    if (chosen == map.id || chosen.starts_with(map.id + "/")) return *map.set;
  }
  const bool is_map_alone = document.patches.empty() && !document.maps.empty();
  return is_map_alone ? *document.maps.front().set : patch_set(document, journal);
}

}  // namespace patchlab
