#include "tests/fuzz/fuzz_targets.h"

#include <algorithm>

#include "engine/cli/chain_file.h"
#include "engine/cli/region_file.h"
#include "engine/io/map_set.h"
#include "engine/io/mesh_data.h"
#include "engine/io/read_scan.h"
#include "engine/io/robot_files.h"
#include "engine/io/scene.h"
#include "engine/map/robot.h"
#include "engine/project/journal.h"

namespace patchlab::test {
namespace {

const std::string fuzzed = "fuzzed";

// A refusal names the file and, in a sentence without control characters, the cause.
Outcome judge_refusal(const Error& error) {
  constexpr std::size_t shortest = 11;  // ": is empty."
  const std::string& message = error.message;
  const auto is_control = [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; };
  if (!message.starts_with(fuzzed + ": ")) return {false, "names no file: " + message};
  if (message.size() < fuzzed.size() + shortest || !message.ends_with('.'))
    return {false, "no sentence: " + message};
  if (std::ranges::any_of(message, is_control)) return {false, "control characters: " + message};
  return {};
}

Outcome judge_scan(const Scan& scan) {
  const std::size_t size = scan.size();
  const auto fits = [size](const auto& attribute) { return attribute.empty() || attribute.size() == size; };
  if (size == 0 || std::uint64_t{scan.width} * scan.height != size) return {true, "size and grid disagree"};
  if (scan.finite.size() != size || !fits(scan.labels) || !fits(scan.colours) || !fits(scan.covariances) ||
      !fits(scan.viewpoints))
    return {true, "an attribute has another size than the points"};
  if (!scan.origin.allFinite() || !rotation(scan.viewpoint).allFinite() ||
      !scan.viewpoint.position.allFinite())
    return {true, "origin or viewpoint is not finite"};
  std::size_t finite = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (scan.point(i).allFinite() != (scan.finite[i] == 1))
      return {true, "a point is finite and marked as not, or not and as it"};
    finite += scan.finite[i];
  }
  return {true, finite == scan.finite_count ? "" : "finite points are counted wrong"};
}

const ReadOptions scan_options = {.intrinsics = Intrinsics{.fx = 500, .fy = 500, .cx = 2, .cy = 1},
                                  .depth_scale = 1000};

using ReadScan = Result<Scan> (*)(std::string_view bytes, const std::string& name,
                                  const ReadOptions& options);

template <ReadScan read>
Outcome feed_scan(std::string_view bytes) {
  const Result<Scan> scan = read(bytes, fuzzed, scan_options);
  return scan ? judge_scan(*scan) : judge_refusal(scan.error());
}

Outcome feed_intrinsics(std::string_view text) {
  const Result<Intrinsics> camera = parse_intrinsics(text, fuzzed);
  if (!camera) return judge_refusal(camera.error());
  return {true, camera->fx > 0.0 && camera->fy > 0.0 ? "" : "a focal length is not positive"};
}

Outcome feed_journal(std::string_view text) {
  const Result<Journal> journal = parse_journal(text, fuzzed);
  if (!journal) return judge_refusal(journal.error());
  if (journal->length > text.size()) return {true, "is longer than its text"};
  for (const Command& command : journal->commands) {
    if (const auto line = journal_line(command); !line)
      return {true, "cannot be written again: " + line.error().message};
  }
  return {true, ""};
}

Outcome feed_patch_set(std::string_view text) {
  const Result<PatchSet> set = read_patch_set(text, fuzzed);
  if (!set) return judge_refusal(set.error());
  if (const auto again = write_patch_set(*set); !again)
    return {true, "cannot be written again: " + again.error().message};
  const Result<PatchMap> map = map_of(*set, fuzzed);
  return map ? Outcome{true, ""} : judge_refusal(map.error());
}

Outcome feed_urdf(std::string_view text) {
  const Result<Robot> robot = read_urdf(text, fuzzed);
  if (!robot) return judge_refusal(robot.error());
  JointValues zeros;
  for (const RobotJoint& joint : robot->joints) {
    if (joint.kind != JointKind::fixed && joint.driver == joint.name) zeros[joint.name] = {};
  }
  const Result<PosedRobot> posed = PosedRobot::make(*robot, zeros);
  if (!posed) return {true, "has no posture: " + posed.error().message};
  for (const std::string& link : robot->links) {
    if (const auto pose = posed->pose(robot->base, link); !pose)
      return {true, "has no pose: " + pose.error().message};
  }
  return {true, ""};
}

Outcome feed_scene(std::string_view text) {
  const Result<SceneDescription> scene = read_scene(text, fuzzed);
  if (!scene) return judge_refusal(scene.error());
  const std::optional<Hit> hit =
      cast_ray(*scene)(scene->camera.pose.position, Eigen::Vector3d(0.1, 0.2, 1.0));
  return {true, !hit || (hit->s > 0.0 && hit->object < scene->objects.size())
                    ? ""
                    : "a ray hits what is not there"};
}

template <auto parse>
Outcome feed_parser(std::string_view text) {
  const auto parsed = parse(text, fuzzed);
  return parsed ? Outcome{true, ""} : judge_refusal(parsed.error());
}

constexpr FuzzTarget targets[] = {{"read_scan", feed_scan<read_scan_bytes>},
                                  {"read_pcd", feed_scan<read_pcd>},
                                  {"read_ply", feed_scan<read_ply>},
                                  {"read_point_table", feed_scan<read_point_table>},
                                  {"read_obj", feed_scan<read_obj>},
                                  {"read_off", feed_scan<read_off>},
                                  {"read_stl", feed_scan<read_stl>},
                                  {"read_kitti", feed_scan<read_kitti>},
                                  {"read_depth_image", feed_scan<read_depth_image>},
                                  {"intrinsics", feed_intrinsics},
                                  {"journal", feed_journal},
                                  {"patch_set", feed_patch_set},
                                  {"urdf", feed_urdf},
                                  {"robot_patches", feed_parser<read_robot_patches>},
                                  {"joints", feed_parser<read_joints>},
                                  {"chain", feed_parser<parse_chain>},
                                  {"pose", feed_parser<parse_pose>},
                                  {"region", feed_parser<parse_region>},
                                  {"scene", feed_scene}};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() { return targets; }

const FuzzTarget* find_fuzz_target(std::string_view name) {
  const auto* const found = std::ranges::find(targets, name, &FuzzTarget::name);
  return found == std::end(targets) ? nullptr : found;
}

}  // namespace patchlab::test
