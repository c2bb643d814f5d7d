// Files about a robot, beside its URDF: joint values with their standard deviations (JSON or CSV), and
// patches designed on its links (JSON). Schemas: assets/schema/joints.schema.json, robot_patches.schema.json.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/map/robot.h"

namespace patchlab {

struct JointFile {
  JointValues values;
  std::string base_in;  // the frame that the base link is fixed in; empty where the file names none
  LinkTolerance tolerance;
};
// JSON {"joints": {"hip": {"value": 0.3, "sigma": 0.002}}, "base_in": "body", "link_tolerance": {"rotation":
// rad, "translation": m}}, or CSV with the header joint,value,sigma. unreadable error with the joint that is
// wrong.
Result<JointFile> read_joints(std::string_view text, const std::string& name);

// unreadable error: names the file, the patch and the member that is wrong; a higher major version is
// refused.
Result<std::vector<RobotPatch>> read_robot_patches(std::string_view text, const std::string& name);

}  // namespace patchlab
