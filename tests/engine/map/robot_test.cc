// Robots from URDF: the paper's chain against KDL's kinematics, and what a bad robot is told.
#include "engine/map/robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "engine/base/file.h"
#include "tests/engine/patch/example_patches.h"
#include "tests/support/monte_carlo.h"

namespace patchlab::test {
namespace {

using testing::HasSubstr;

std::string numbers(const Vector3d& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

std::string joint_xml(const std::string& name, const std::string& type, const std::string& parent,
                      const std::string& child, const std::string& more) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/>" + more + "<limit lower='-3' upper='3' effort='1' velocity='1'/></joint>";
}

std::string link_xml(const std::string& name) { return "<link name='" + name + "'/>"; }

struct Arm {
  Robot robot;
  JointValues values;
};

// Seven joints of random places, axes, values and sigmas; the fourth slides.
Arm random_arm(Random& random) {
  std::string xml = "<robot name='arm'>" + link_xml("l0");
  JointValues values;
  for (int i = 1; i <= 7; ++i) {
    const std::string n = std::to_string(i), name = "j" + n;
    xml += link_xml("l" + n) +
           joint_xml(name, i == 4 ? "prismatic" : "revolute", "l" + std::to_string(i - 1), "l" + n,
                     "<origin xyz='" + numbers(0.3 * random.unit3()) + "' rpy='" + numbers(random.normal3()) +
                         "'/><axis xyz='" + numbers(random.unit3()) + "'/>");
    values[name] = {i == 4 ? random.uniform(0.0, 0.2) : random.uniform(-2.5, 2.5),
                    random.uniform(0.001, 0.005)};
  }
  return {*read_urdf(xml + "</robot>", "arm.urdf"), values};
}

KDL::Vector kdl(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

KDL::Frame kdl(const Pose& pose) {
  const Matrix3d R = exp_map(pose.r);
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
          kdl(pose.t)};
}

// Pose and covariance of the end by KDL: twists (velocity of the end, rotation) in the base's axes.
struct KdlEnd {
  Matrix3d R;
  Vector3d t;
  Matrix6d cov_twist;
};
KdlEnd kdl_end(const Arm& arm) {
  KDL::Chain chain;
  KDL::JntArray q(7);
  Eigen::Matrix<double, 7, 1> variance;
  for (unsigned i = 0; i < 7; ++i) {
    const RobotJoint& joint = arm.robot.joints[i];
    const KDL::Frame place = kdl(joint.parent_from_joint);
    const auto type = joint.kind == JointKind::sliding ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
    chain.addSegment(KDL::Segment(KDL::Joint(joint.name, place.p, place.M * kdl(joint.axis), type), place));
    q(i) = arm.values.at(joint.name).value;
    variance[i] = std::pow(arm.values.at(joint.name).sigma, 2);
  }
  KDL::Frame end;
  KDL::Jacobian J(7);
  KDL::ChainFkSolverPos_recursive(chain).JntToCart(q, end);
  KDL::ChainJntToJacSolver(chain).JntToJac(q, J);
  Matrix3d R;
  for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = end.M(i / 3, i % 3);
  return {R, {end.p.x(), end.p.y(), end.p.z()}, J.data * variance.asDiagonal() * J.data.transpose()};
}

TEST(Robot, AgreesWithKdlOnThePoseAndCovarianceOfASevenJointArm) {
  SeededRandom random;
  for (int trial = 0; trial < 30; ++trial) {
    const Arm arm = random_arm(random);
    const UncertainPose end = *PosedRobot::make(arm.robot, arm.values)->pose("l0", "l7");
    const KdlEnd expected = kdl_end(arm);
    EXPECT_LT((exp_map(end.pose.r) - expected.R).norm(), 1e-9);
    EXPECT_LT((end.pose.t - expected.t).norm(), 1e-9);
    const Matrix6d G = ros_fixed_axes_from_rt(end.pose), found = G * end.covariance * G.transpose();
    EXPECT_LT((found - expected.cov_twist).norm(), 1e-9 * expected.cov_twist.norm());
  }
}

TEST(Robot, RelatesTwoLinksByTheJointsBetweenThem) {
  SeededRandom random;
  const Arm arm = random_arm(random);
  const PosedRobot robot = *PosedRobot::make(arm.robot, arm.values, {0.001, 0.0005});
  EXPECT_EQ(robot.chain("l3", "l5")->size(), 4u);
  EXPECT_EQ(robot.pose("l4", "l4")->covariance.norm(), 0.0);
  const UncertainPose there = *robot.pose("l2", "l6"), back = inverse(*robot.pose("l6", "l2"));
  EXPECT_LT((there.covariance - back.covariance).norm(), 1e-12 * there.covariance.norm());
  EXPECT_LT((compose(*robot.chain("l0", "l7")).covariance - robot.pose("l0", "l7")->covariance).norm(),
            1e-15);
}

TEST(Robot, HasTheCovarianceOfSampledJoints) {
  SeededRandom random;
  const Arm arm = random_arm(random);
  const UncertainPose end = *PosedRobot::make(arm.robot, arm.values)->pose("l0", "l7");
  Eigen::MatrixXd cov = Eigen::MatrixXd::Zero(7, 7);
  for (int i = 0; i < 7; ++i) cov(i, i) = std::pow(arm.values.at("j" + std::to_string(i + 1)).sigma, 2);
  const auto change = [&](const VectorXd& e) -> VectorXd {
    JointValues moved = arm.values;
    for (int i = 0; i < 7; ++i) moved["j" + std::to_string(i + 1)].value += e[i];
    Pose pose = PosedRobot::make(arm.robot, moved)->pose("l0", "l7")->pose;
    pose.r = nearest_branch(pose.r, end.pose.r).r;
    return pose.vector() - end.pose.vector();
  };
  constexpr int count = 2000;
  EXPECT_TRUE(covariance_agrees(end.covariance, sampled_covariance(random, cov, count, change), count));
}

// Two turns about one axis by one uncertain variable: twice the angle, four times the variance.
TEST(Robot, CountsAMimickedJointOnce) {
  const std::string z = "<axis xyz='0 0 2'/>";
  const Robot robot = *read_urdf("<robot name='m'>" + link_xml("a") + link_xml("b") + link_xml("c") +
                                     joint_xml("drive", "continuous", "a", "b", z) +
                                     joint_xml("follow", "continuous", "b", "c",
                                               z + "<mimic joint='drive' multiplier='1' offset='0.1'/>") +
                                     "</robot>",
                                 "m.urdf");
  const PosedRobot posed = *PosedRobot::make(robot, {{"drive", {0.3, 0.01}}});
  const UncertainPose end = *posed.pose("a", "c");
  EXPECT_NEAR(end.pose.r.z(), 0.7, 1e-15);
  EXPECT_NEAR(end.covariance(2, 2), 4e-4, 1e-15);
  FrameTree frames;
  EXPECT_THAT(hang_robot(frames, posed, "map").error().message, HasSubstr("mimics the uncertain \"drive\""));
  EXPECT_THAT(PosedRobot::make(robot, {{"drive", {}}, {"follow", {}}}).error().message,
              HasSubstr("takes no value of its own"));
}

TEST(Robot, HangsInATreeOfFrames) {
  SeededRandom random;
  const Arm arm = random_arm(random);
  const PosedRobot posed = *PosedRobot::make(arm.robot, arm.values);
  FrameTree frames;
  ASSERT_TRUE(hang_robot(frames, posed, "body"));
  EXPECT_LT((frames.pose("body", "l7")->covariance - posed.pose("l0", "l7")->covariance).norm(), 1e-15);
}

TEST(Robot, PutsItsPatchesWhereItsLinksAre) {
  SeededRandom random;
  const Arm arm = random_arm(random);
  const PosedRobot posed = *PosedRobot::make(arm.robot, arm.values);
  Patch sole = random_patch(random, all_cases().back());
  sole.covariance.reset();
  sole.covariance_local.reset();
  const auto placed = robot_patches_in(posed, std::vector<RobotPatch>{{"sole", "l7", sole}});
  ASSERT_TRUE(placed);
  EXPECT_TRUE(same_patch((*placed)[0].patch, transform(*posed.pose("l0", "l7"), sole)));
  EXPECT_EQ((*placed)[0].link, "l0");
  EXPECT_THAT(robot_patches_in(posed, std::vector<RobotPatch>{{"sole", "tail", sole}}).error().message,
              HasSubstr("no link \"tail\""));
}

TEST(Robot, AsksForWhatIsMissing) {
  SeededRandom random;
  const Arm arm = random_arm(random);
  JointValues values = arm.values;
  values.erase("j3");
  EXPECT_THAT(PosedRobot::make(arm.robot, values).error().message, HasSubstr("\"j3\""));
  values = arm.values;
  values["j9"] = {};
  EXPECT_THAT(PosedRobot::make(arm.robot, values).error().message, HasSubstr("no joint \"j9\""));
  values = arm.values;
  values["j1"].sigma = -1.0;
  EXPECT_THAT(PosedRobot::make(arm.robot, values).error().message, HasSubstr("\"j1\""));
  EXPECT_THAT(PosedRobot::make(arm.robot, arm.values)->pose("l0", "hand").error().message,
              HasSubstr("no link \"hand\""));
}

// What libFuzzer found: a character that is cut off took the parser past the end of the text.
TEST(Urdf, ThatIsNotUtf8IsRefusedWithThePlace) {
  const Result<Robot> robot = read_urdf("<robot name=\"r\xf0", "r.urdf");
  ASSERT_FALSE(robot);
  EXPECT_EQ(robot.error().message, "r.urdf: byte 15 is not of UTF-8 text; correct the URDF.");
}

TEST(Urdf, ThatIsNoRobotIsRefusedInOneSentence) {
  const std::string ab = link_xml("a") + link_xml("b");
  std::string crowd;
  for (int i = 0; i < 1001; ++i) crowd += "x" + std::to_string(i) + "='=' ";
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<a>";
  const std::pair<std::string, std::string> bad[] = {
      {"", "no robot"},
      {"<robot", "no robot"},
      {"<robot name='r'></robot>", "no robot"},
      {"<robot name='r'>" + ab + "</robot>", "no robot"},
      {"<robot name='r'>" + ab + joint_xml("x", "fixed", "a", "b", "") +
           joint_xml("y", "fixed", "b", "a", "") + "</robot>",
       "close a loop"},
      {"<robot name='r'>" + ab + link_xml("c") + joint_xml("x", "fixed", "a", "c", "") +
           joint_xml("y", "fixed", "b", "c", "") + "</robot>",
       "link \"c\" is the child of two joints"},
      {"<robot name='r'>" + ab + joint_xml("x", "floating", "a", "b", "") + "</robot>", "\"x\" is neither"},
      {"<robot name='r'>" + ab + joint_xml("x", "revolute", "a", "b", "<axis xyz='0 0 0'/>") + "</robot>",
       "axis of no length"},
      {"<robot name='r'>" + ab + joint_xml("x", "revolute", "a", "b", "<mimic joint='z'/>") + "</robot>",
       "mimics \"z\""},
      {"<robot name='r'>" + ab + joint_xml("x", "fixed", "a", "b", "<origin xyz='%s%s%n%n 0 0'/>") +
           "</robot>",
       "an element is malformed"},
      {"<robot name='r'>" + ab + joint_xml("x", "revolute", "a", "b", "<mimic joint='x'/>") + "</robot>", ""},
      {"<robot name='r'>" + ab + "<link name='c' " + crowd + "/></robot>", "more than 1000 attributes"},
      {deep, "nested"}};
  for (const auto& [xml, says] : bad) {
    testing::internal::CaptureStderr();
    const Result<Robot> robot = read_urdf(xml, "bad.urdf");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    if (says.empty()) continue;
    ASSERT_FALSE(robot) << xml;
    EXPECT_THAT(robot.error().message, HasSubstr(says));
    EXPECT_THAT(robot.error().message, HasSubstr("bad.urdf: "));
  }
}

TEST(Walker, StandsOnItsSolesAndShowsItsToes) {
  const std::filesystem::path file = std::filesystem::path(PATCHLAB_SOURCE_DIR) / "assets/walker.urdf";
  const Result<Robot> walker = read_urdf(as_text(*read_file(file)), "walker.urdf");
  ASSERT_TRUE(walker) << walker.error().message;
  JointValues straight;
  for (const RobotJoint& joint : walker->joints) {
    if (joint.kind != JointKind::fixed) straight[joint.name] = {};
  }
  EXPECT_EQ(straight.size(), 12u);
  const UncertainPose foot = *PosedRobot::make(*walker, straight)->pose("body", "left_foot");
  EXPECT_NEAR(foot.pose.t.z(), -0.84, 1e-12);
  EXPECT_NEAR(foot.pose.t.y(), 0.11, 1e-12);
}

}  // namespace
}  // namespace patchlab::test
