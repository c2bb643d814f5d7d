#include <algorithm>
#include <cmath>

#include "engine/base/file.h"
#include "engine/io/map_set.h"
#include "engine/io/mesh_data.h"
#include "engine/io/robot_files.h"
#include "engine/project/map_commands.h"
#include "engine/project/placed.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

Error mistake(std::string message) { return {ErrorCode::usage, std::move(message)}; }
Error missing(const std::string& what, const std::string& id) {
  return mistake("There is no " + what + " '" + id + "'.");
}

// A new id, or the one that is asked for where it is free.
Result<void> claim(std::string& id, const std::string& stem, const Document& document) {
  if (id.empty()) id = free_id(document, stem);
  if (is_taken(document, id)) return mistake("The id '" + id + "' is taken already.");
  return {};
}

// What `reader` makes of a recorded file; fills in its hash, or refuses other bytes.
template <class Reader>
auto read_recorded(const std::string& name, std::string& hash, const ApplyOptions& options,
                   const Reader& reader) -> decltype(reader(std::string_view(), name)) {
  const fs::path file = options.folder / name;
  const Result<Bytes> bytes = read_file(file, default_file_limit, options.progress);
  if (!bytes) return bytes.error();
  const std::string found = sha256(as_text(*bytes));
  if (!hash.empty() && hash != found) {
    return Error{ErrorCode::refused, file.string() + ": is not the file that was recorded: its sha256 is " +
                                         found + ", the recorded one " + hash + "; restore it."};
  }
  auto value = reader(as_text(*bytes), file.string());
  if (value) hash = found;
  return value;
}

// Meshes are named by where they are seen from the URDF, or by a package that it lies in.
fs::path mesh_file(const std::string& named, const fs::path& folder) {
  constexpr std::string_view package = "package://", plain = "file://";
  if (named.starts_with(plain)) return named.substr(plain.size());
  if (!named.starts_with(package)) return folder / named;
  const std::string inside = named.substr(package.size());
  const std::string below = inside.substr(std::min(inside.size(), inside.find('/') + 1));
  for (fs::path at = fs::absolute(folder); at.has_relative_path(); at = at.parent_path()) {
    std::error_code ignored;
    for (const std::string& path : {inside, below})
      if (fs::exists(at / path, ignored)) return at / path;
  }
  return folder / below;
}

void read_meshes(RobotModel& model, const fs::path& folder) {
  for (const LinkShape& shape : model.robot.shapes) {
    model.meshes.emplace_back();
    if (shape.kind != LinkShapeKind::mesh) continue;
    const fs::path file = mesh_file(shape.file, folder);
    const Result<Bytes> bytes = read_file(file);
    Result<MeshData> mesh = bytes ? parse_mesh(as_text(*bytes), file.string(), {}) : bytes.error();
    if (mesh)
      model.meshes.back() = std::make_shared<const MeshData>(std::move(*mesh));
    else
      model.notices.push_back("Link \"" + shape.link +
                              "\" is drawn without its mesh: " + mesh.error().message);
  }
}

JointValues at_rest(const Robot& robot) {
  JointValues values;
  for (const RobotJoint& joint : robot.joints) {
    if (joint.kind == JointKind::fixed || joint.driver != joint.name) continue;
    values[joint.name].value = joint.limits ? std::clamp(0.0, joint.limits->lower, joint.limits->upper) : 0.0;
  }
  return values;
}

Result<RobotEntry> read_robot(OpenRobot& open, const ApplyOptions& options) {
  Result<Robot> robot = read_recorded(open.file, open.sha256, options, read_urdf);
  if (!robot) return robot.error();
  JointFile joints{at_rest(*robot), {}, {}};
  if (!open.joints.empty()) {
    Result<JointFile> read = read_recorded(open.joints, open.joints_sha256, options, read_joints);
    if (!read) return read.error();
    joints = std::move(*read);
  }
  RobotModel model{std::move(*robot), {}, joints.tolerance, {}, {}};
  if (!open.patches.empty()) {
    Result<std::vector<RobotPatch>> read =
        read_recorded(open.patches, open.patches_sha256, options, read_robot_patches);
    if (!read) return read.error();
    model.patches = std::move(*read);
  }
  read_meshes(model, (options.folder / open.file).parent_path());
  const std::string frame = joints.base_in.empty() ? model.robot.base : joints.base_in;
  return RobotEntry{open.id,       model.robot.name,
                    frame,         std::make_shared<const RobotModel>(std::move(model)),
                    joints.values, true};
}

// Values for every joint, and links for every patch.
Result<void> check(const RobotEntry& entry) {
  const Result<PosedRobot> robot = posed(entry);
  if (!robot) return robot.error();
  const Result<std::vector<RobotPatch>> placed = robot_patches_in(*robot, entry.model->patches);
  return placed ? Result<void>{} : placed.error();
}

}  // namespace

Result<void> run(OpenMap& open, Document& document, const ApplyOptions& options) {
  if (const Result<void> claimed = claim(open.id, "map", document); !claimed) return claimed;
  Result<PatchSet> set = read_recorded(open.file, open.sha256, options, read_patch_set);
  if (!set) return set.error();
  const Result<PatchMap> map = map_of(*set, open.file);
  if (!map) return map.error();
  document.maps.push_back({open.id, fs::path(open.file).filename().string(),
                           std::make_shared<const PatchMap>(*map),
                           std::make_shared<const PatchSet>(std::move(*set)), true});
  return {};
}

Result<void> run(OpenRobot& open, Document& document, const ApplyOptions& options) {
  if (const Result<void> claimed = claim(open.id, "robot", document); !claimed) return claimed;
  Result<RobotEntry> robot = read_robot(open, options);
  if (!robot) return robot.error();
  if (const Result<void> checked = check(*robot); !checked) return checked;
  document.robots.push_back(std::move(*robot));
  return {};
}

Result<void> run(SetJoint& set, Document& document, const ApplyOptions&) {
  const auto robot = std::ranges::find(document.robots, set.robot, &RobotEntry::id);
  if (robot == document.robots.end()) return missing("robot", set.robot);
  if (!robot->joints.contains(set.joint)) return missing("joint that moves by itself", set.joint);
  JointValue& joint = robot->joints[set.joint];
  joint = {set.value, set.sigma.value_or(joint.sigma)};
  return check(*robot);
}

Result<void> run(Place& place, Document& document, const ApplyOptions&) {
  const auto known = std::ranges::find(document.frames, place.frame, &FrameEntry::name);
  FrameEntry& entry = known == document.frames.end() ? document.frames.emplace_back() : *known;
  entry = {place.frame, place.in, place.pose};
  FrameTree tree;
  for (const FrameEntry& frame : document.frames) {
    if (const Result<void> added = tree.add(frame.name, frame.in, frame.pose); !added) return added;
  }
  return {};
}

}  // namespace patchlab
