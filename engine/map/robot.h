// A robot of links and joints, and the patches designed on its links: where kinematics puts them, with what
// the uncertainty of the joints does to them.
//
// Links are joined by Eqs. (9), (10), (42): a joint is two elements of a chain, the place of the joint in its
// parent link (with the link's tolerance), then its motion (axis q, 0) or (0, axis q), in which q stands
// linearly, so that its variance is exact. A joint that mimics another shares its error: the two are one
// variable.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/map/frames.h"
#include "engine/patch/patch.h"
#include "engine/pose/chain.h"

namespace patchlab {

enum class JointKind { fixed, turning, sliding };

struct JointLimits {
  double lower = 0.0, upper = 0.0;  // rad, or m of a sliding joint
};

struct RobotJoint {
  std::string name, parent, child;  // of links
  JointKind kind = JointKind::fixed;
  Pose parent_from_joint;
  Vector3d axis = Vector3d::UnitX();  // unit, in the joint's frame
  std::string driver;  // the joint whose value moves this one: itself, or the one that it mimics
  double multiplier = 1.0, offset = 0.0;   // q = multiplier q_driver + offset
  std::optional<JointLimits> limits = {};  // none: it turns as far as one likes
};

// What a link looks like: for pictures alone.
enum class LinkShapeKind { box, cylinder, sphere, mesh };
struct LinkShape {
  std::string link;
  LinkShapeKind kind = LinkShapeKind::box;
  Pose link_from_shape;
  // m: sides of a box; radius, radius and length (along z) of a cylinder; radius of a sphere, three times. Of
  // a mesh the scale.
  Vector3d size = Vector3d::Ones();
  std::string file = {};  // of a mesh, as the URDF names it
};

struct Robot {
  std::string name, base;  // the root link
  std::vector<std::string> links;
  std::vector<RobotJoint> joints;      // parents before children
  std::vector<LinkShape> shapes = {};  // visual ones; of a link without any, those that it collides with
};

// URDF: fixed, revolute, continuous and prismatic joints, also those that mimic others. unreadable error with
// what is wrong and where: no XML, no single root, a loop, an axis of no length, a joint of another kind.
Result<Robot> read_urdf(std::string_view text, const std::string& name);

struct JointValue {
  double value = 0.0, sigma = 0.0;  // rad, or m of a sliding joint
};
using JointValues = std::map<std::string, JointValue>;

// Standard deviations of where a joint sits in its parent link, in each direction: of every joint alike.
struct LinkTolerance {
  double rotation = 0.0;     // rad
  double translation = 0.0;  // m
};

// A robot in one posture.
class PosedRobot {
 public:
  // usage error where a moving joint has no value (one that mimics needs none), where a value is for no
  // joint, or a value or sigma is not finite or sigma negative.
  static Result<PosedRobot> make(const Robot& robot, const JointValues& values,
                                 const LinkTolerance& tolerance = {});

  const Robot& robot() const { return robot_; }
  // The pose to_from_from of two links; joints that both share drop out. usage error for an unknown link.
  Result<UncertainPose> pose(const std::string& to, const std::string& from) const;
  double sigma(const RobotJoint& joint) const;  // of the value that drives it
  // The same as elements of a chain, whose covariances count mimicking joints as independent.
  Result<Chain> chain(const std::string& to, const std::string& from) const;

 private:
  struct Step {
    const RobotJoint* joint;
    int phi;
  };
  PosedRobot(const Robot& robot, const JointValues& values, const LinkTolerance& tolerance)
      : robot_(robot), values_(values), tolerance_(tolerance) {}
  Result<std::vector<Step>> steps(const std::string& to, const std::string& from) const;
  Result<std::vector<const RobotJoint*>> to_base(const std::string& link) const;
  ChainElement place(const Step& step) const;
  ChainElement motion(const Step& step) const;

  Robot robot_;
  JointValues values_;
  LinkTolerance tolerance_;
};

// A patch in the frame of a link.
struct RobotPatch {
  std::string id, link;
  Patch patch;
};
// The patches in the frame of a link (of the base, where none is named). Each has the covariance of its own
// chain; patches of one limb share joints, so relate two of them by `pose` between their links, not by these.
Result<std::vector<RobotPatch>> robot_patches_in(const PosedRobot& robot, std::span<const RobotPatch> patches,
                                                 const std::string& frame = {});

// Hangs the links into a tree of frames, the base in `base_in`. usage error where an uncertain joint is
// mimicked: a tree takes its poses as independent.
Result<void> hang_robot(FrameTree& frames, const PosedRobot& robot, const std::string& base_in);

}  // namespace patchlab
