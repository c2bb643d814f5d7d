#include <memory>

#include "engine/base/file.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/io/map_set.h"
#include "engine/io/patch_set.h"
#include "engine/io/robot_files.h"

namespace patchlab {
namespace {

struct RobotRequest {
  std::string urdf, joints, patches, frame;
  std::string output = "-";
  bool json = false;
};

template <class Read>
auto read(const std::string& file, const Read& reader) -> decltype(reader(std::string_view(), file)) {
  const Result<Bytes> bytes = read_file(file);
  if (!bytes) return bytes.error();
  return reader(as_text(*bytes), file == "-" ? "standard input" : file);
}

// An error of what a file says.
Error in_file(const std::string& file, const Error& error) {
  return {error.code, (file == "-" ? "standard input" : file) + ": " + error.message};
}

// A frame of the output: a link, or the frame that the base is fixed in.
bool names_base(const RobotRequest& request, const JointFile& joints) {
  return request.frame.empty() || request.frame == joints.base_in;
}

Result<PatchSet> patches_of_robot(const RobotRequest& request) {
  const auto robot = read(request.urdf, read_urdf);
  if (!robot) return robot.error();
  const auto joints = read(request.joints, read_joints);
  if (!joints) return joints.error();
  const auto patches = read(request.patches, read_robot_patches);
  if (!patches) return patches.error();
  const auto posed = PosedRobot::make(*robot, joints->values, joints->tolerance);
  if (!posed) return in_file(request.joints, posed.error());
  const std::string to = names_base(request, *joints) ? robot->base : request.frame;
  if (const auto frame = posed->pose(to, robot->base); !frame) return in_file("--frame", frame.error());
  const auto placed = robot_patches_in(*posed, *patches, to);
  if (!placed) return in_file(request.patches, placed.error());
  PatchSet set;
  if (placed->size() > 1) state_shared_errors(set);  // by the joints between them
  for (std::size_t i = 0; i < placed->size(); ++i) {
    PatchRecord record;
    record.id = record.name = (*placed)[i].id;
    record.frame_id = names_base(request, *joints) && !joints->base_in.empty() ? joints->base_in : to;
    record.patch = (*placed)[i].patch;
    record.provenance = {{"robot", robot->name}, {"link", (*patches)[i].link}};
    set.patches.push_back(record);
  }
  return set;
}

Result<int> place_patches(const RobotRequest& request) {
  const Result<PatchSet> set = patches_of_robot(request);
  if (!set) return set.error();
  const Result<std::string> text = write_patch_set(*set);
  if (!text) return text.error();
  Outputs outputs;
  outputs.add(request.output, *text);
  return outputs.write();
}

}  // namespace

Action set_up_map_robot(CLI::App& app) {
  const auto request = std::make_shared<RobotRequest>();
  app.add_option("urdf", request->urdf, "the robot")->required();
  app.add_option("--joints", request->joints,
                 "joint values and sigmas: JSON, or CSV with the header joint,value,sigma")
      ->required();
  app.add_option("--patches", request->patches, "patches designed on its links")->required();
  app.add_option("--frame", request->frame,
                 "a link to see them from; the frame that the base is fixed in without it");
  app.add_option("-o,--output", request->output, "where to write the patch set; standard output without it");
  app.add_flag("--json", request->json, "print JSON, which it does anyway");
  return [request] { return place_patches(*request); };
}

}  // namespace patchlab
