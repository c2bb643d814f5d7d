#include "engine/map/robot.h"

#include <algorithm>
#include <cmath>

namespace patchlab {
namespace {

Error robot_error(const std::string& sentence) { return {ErrorCode::usage, sentence}; }

const RobotJoint* joint_named(const Robot& robot, const std::string& name) {
  const auto at = std::ranges::find(robot.joints, name, &RobotJoint::name);
  return at == robot.joints.end() ? nullptr : &*at;
}

Result<void> check_values(const Robot& robot, const JointValues& values) {
  for (const RobotJoint& joint : robot.joints) {
    if (joint.kind == JointKind::fixed || joint.driver != joint.name || values.contains(joint.name)) continue;
    return robot_error("Joint \"" + joint.name + "\" of robot \"" + robot.name +
                       "\" has no value; give it one.");
  }
  for (const auto& [name, value] : values) {
    const RobotJoint* joint = joint_named(robot, name);
    if (joint == nullptr)
      return robot_error("There is no joint \"" + name + "\" in robot \"" + robot.name +
                         "\"; leave it out, or correct its name.");
    if (joint->kind == JointKind::fixed)
      return robot_error("Joint \"" + name + "\" is fixed and takes no value; leave it out.");
    if (joint->driver != name)
      return robot_error("Joint \"" + name + "\" mimics \"" + joint->driver +
                         "\" and takes no value of its own; leave it out.");
    if (!std::isfinite(value.value) || !std::isfinite(value.sigma) || value.sigma < 0.0) {
      return robot_error("The value of joint \"" + name +
                         "\" must be finite, and its sigma finite and not negative.");
    }
  }
  return {};
}

// d (r, t) / d q of a motion.
Vector6d along(const RobotJoint& joint) {
  Vector6d out = Vector6d::Zero();
  if (joint.kind == JointKind::turning) out.head<3>() = joint.axis;
  if (joint.kind == JointKind::sliding) out.tail<3>() = joint.axis;
  return out;
}

}  // namespace

Result<PosedRobot> PosedRobot::make(const Robot& robot, const JointValues& values,
                                    const LinkTolerance& tolerance) {
  if (const Result<void> good = check_values(robot, values); !good) return good.error();
  return PosedRobot(robot, values, tolerance);
}

Result<std::vector<const RobotJoint*>> PosedRobot::to_base(const std::string& link) const {
  if (std::ranges::find(robot_.links, link) == robot_.links.end()) {
    return robot_error("There is no link \"" + link + "\" in robot \"" + robot_.name +
                       "\"; correct its name.");
  }
  std::vector<const RobotJoint*> out;
  for (std::string at = link; at != robot_.base; at = out.back()->parent) {
    out.push_back(&*std::ranges::find(robot_.joints, at, &RobotJoint::child));
  }
  return out;
}

Result<std::vector<PosedRobot::Step>> PosedRobot::steps(const std::string& to,
                                                        const std::string& from) const {
  const auto up = to_base(to), down = to_base(from);
  if (!up) return up.error();
  if (!down) return down.error();
  auto up_end = up->end(), down_end = down->end();
  while (up_end != up->begin() && down_end != down->begin() && *(up_end - 1) == *(down_end - 1)) {
    --up_end;
    --down_end;
  }
  std::vector<Step> out;
  for (auto at = up->begin(); at != up_end; ++at) out.push_back({*at, -1});
  while (down_end != down->begin()) out.push_back({*--down_end, +1});
  return out;
}

double PosedRobot::sigma(const RobotJoint& joint) const {
  const auto value = values_.find(joint.driver);
  return value == values_.end() ? 0.0 : value->second.sigma;
}

ChainElement PosedRobot::place(const Step& step) const {
  Vector6d sigmas;
  sigmas << Vector3d::Constant(tolerance_.rotation), Vector3d::Constant(tolerance_.translation);
  // The tolerance turns the joint about its own place: w in its axes, r by Jr^-1.
  Matrix6d J = Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = right_jacobian_inverse(step.joint->parent_from_joint.r);
  J = J * sigmas.asDiagonal();
  return {{step.joint->parent_from_joint, J * J.transpose()}, step.phi};
}

ChainElement PosedRobot::motion(const Step& step) const {
  const RobotJoint& joint = *step.joint;
  const auto value = values_.find(joint.driver);
  const double q = value == values_.end() ? 0.0 : joint.multiplier * value->second.value + joint.offset;
  const Vector6d direction = along(joint), spread = direction * (joint.multiplier * sigma(joint));
  return {{{q * direction.head<3>(), q * direction.tail<3>()}, spread * spread.transpose()}, step.phi};
}

Result<Chain> PosedRobot::chain(const std::string& to, const std::string& from) const {
  const auto path = steps(to, from);
  if (!path) return path.error();
  Chain out;
  for (const Step& step : *path) {
    const ChainElement first = place(step), second = motion(step);
    out.push_back(step.phi > 0 ? first : second);
    out.push_back(step.phi > 0 ? second : first);
  }
  return out;
}

Result<UncertainPose> PosedRobot::pose(const std::string& to, const std::string& from) const {
  const auto path = steps(to, from);
  if (!path) return path.error();
  const Chain elements = *chain(to, from);
  if (elements.empty()) return UncertainPose{};
  const Eigen::Matrix<double, 6, Eigen::Dynamic> J = J_chain(elements);  // Eq. (46)
  std::map<std::string, Vector6d> by_variable;
  Matrix6d cov = Matrix6d::Zero();
  for (std::size_t i = 0; i < path->size(); ++i) {
    const auto& [joint, phi] = (*path)[i];
    const auto at = 12 * static_cast<Eigen::Index>(i), place_at = phi > 0 ? at : at + 6,
               motion_at = phi > 0 ? at + 6 : at;
    const Matrix6d J_place = J.middleCols<6>(place_at);
    cov += J_place * place((*path)[i]).pose.covariance * J_place.transpose();
    const Vector6d column = J.middleCols<6>(motion_at) * along(*joint) * (joint->multiplier * sigma(*joint));
    by_variable.try_emplace(joint->driver, Vector6d::Zero()).first->second += column;
  }
  for (const auto& [driver, column] : by_variable)
    cov += column * column.transpose();  // Eq. (42), one term a variable
  return UncertainPose{chain_pose(elements), 0.5 * (cov + cov.transpose())};
}

Result<std::vector<RobotPatch>> robot_patches_in(const PosedRobot& robot, std::span<const RobotPatch> patches,
                                                 const std::string& frame) {
  const std::string& to = frame.empty() ? robot.robot().base : frame;
  std::vector<RobotPatch> out;
  for (const RobotPatch& patch : patches) {
    const auto pose = robot.pose(to, patch.link);
    if (!pose) return robot_error("Patch \"" + patch.id + "\": " + pose.error().message);
    out.push_back({patch.id, to, transform(*pose, patch.patch)});
  }
  return out;
}

Result<void> hang_robot(FrameTree& frames, const PosedRobot& robot, const std::string& base_in) {
  const Robot& body = robot.robot();
  if (base_in != body.base) {
    if (const auto added = frames.add(body.base, base_in, {}); !added) return added.error();
  }
  for (const RobotJoint& joint : body.joints) {
    if (joint.driver != joint.name && robot.sigma(joint) > 0.0) {
      return robot_error("Joint \"" + joint.name + "\" mimics the uncertain \"" + joint.driver +
                         "\"; frames count their poses as independent, so ask the robot itself for poses.");
    }
    if (const auto added = frames.add(joint.child, joint.parent, *robot.pose(joint.parent, joint.child));
        !added)
      return added.error();
  }
  return {};
}

}  // namespace patchlab
