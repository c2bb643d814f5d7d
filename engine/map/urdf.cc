#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>
#include <mutex>
#include <set>

#include "engine/base/printable.h"
#include "engine/base/utf8.h"
#include "engine/map/robot.h"
#include "engine/map/urdf_parts.h"

namespace patchlab {
namespace {

constexpr int deepest = 100;  // elements within elements
constexpr std::size_t most_links = 10000;
constexpr std::size_t most_attributes = 1000;  // of one element

// urdfdom says what is wrong to a log; the first sentence of it goes into ours, and nothing is printed. It
// formats with text of the file as the format, so that where a file holds % it must not speak.
class Listener : public console_bridge::OutputHandler {
 public:
  explicit Listener(bool may_speak) : lock_(turn()), level_(console_bridge::getLogLevel()) {
    console_bridge::useOutputHandler(this);
    console_bridge::setLogLevel(may_speak ? console_bridge::CONSOLE_BRIDGE_LOG_ERROR
                                          : console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  }
  ~Listener() override {
    console_bridge::setLogLevel(level_);
    console_bridge::restorePreviousOutputHandler();
  }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (first_.empty() && level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) first_ = text;
  }
  const std::string& first() const { return first_; }

 private:
  static std::mutex& turn() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  console_bridge::LogLevel level_;
  std::string first_;
};

// The parser recurses; a file nested so deep is none of a robot.
bool too_deep(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '<' && (std::isalpha(static_cast<unsigned char>(text[i + 1])) || text[i + 1] == '_'))
      ++depth;
    if ((text[i] == '<' && text[i + 1] == '/') || (text[i] == '/' && text[i + 1] == '>')) --depth;
    if (depth > deepest) return true;
  }
  return false;
}

// The parser looks for each attribute among all before it in the element.
bool has_crowd_of_attributes(std::string_view text) {
  std::size_t attributes = 0;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '<' || c == '>') {
      attributes = 0;
    } else if (c == '=' && ++attributes > most_attributes) {
      return true;
    }
  }
  return false;
}

std::string link_of(const TiXmlElement& joint, const char* end) {
  const TiXmlElement* const element = joint.FirstChildElement(end);
  const char* const link = element == nullptr ? nullptr : element->Attribute("link");
  return link == nullptr ? std::string() : link;
}

// Why the joints make no tree, or nothing. Asked before urdfdom reads them: it counts references to its
// links, and a loop of them would never be freed.
std::string no_tree(const std::string& text) {
  TiXmlDocument document;
  document.Parse(text.c_str());
  const TiXmlElement* const robot = document.FirstChildElement("robot");
  const TiXmlElement* joint = robot == nullptr ? nullptr : robot->FirstChildElement("joint");
  std::map<std::string, std::string> parents;
  for (; joint != nullptr; joint = joint->NextSiblingElement("joint")) {
    const std::string child = link_of(*joint, "child");
    if (!child.empty() && !parents.emplace(child, link_of(*joint, "parent")).second)
      return "link \"" + child + "\" is the child of two joints";
  }
  std::set<std::string> in_order;
  for (const auto& [link, unused] : parents) {
    std::set<std::string> path;
    for (auto at = parents.find(link); at != parents.end() && !in_order.contains(at->first);
         at = parents.find(at->second)) {
      if (!path.insert(at->first).second) return "the joints above link \"" + at->first + "\" close a loop";
    }
    in_order.merge(path);
  }
  return {};
}

urdf::ModelInterfaceSharedPtr parsed(const std::string& text, std::string& problem) {
  const bool has_percent = text.find('%') != std::string::npos;
  Listener listener(!has_percent);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  if (!model && problem.empty())
    problem = has_percent ? "an element is malformed; without % signs in the file it can be told which"
                          : listener.first();
  return model;
}

struct Kind {
  int urdf;
  JointKind kind;
};
constexpr Kind kinds[] = {{urdf::Joint::FIXED, JointKind::fixed},
                          {urdf::Joint::REVOLUTE, JointKind::turning},
                          {urdf::Joint::CONTINUOUS, JointKind::turning},
                          {urdf::Joint::PRISMATIC, JointKind::sliding}};

// A joint as a RobotJoint; the reason why it is none in `problem`.
RobotJoint joint_of(const urdf::Joint& from, std::string& problem) {
  RobotJoint joint;
  joint.name = joint.driver = from.name;
  joint.parent = from.parent_link_name;
  joint.child = from.child_link_name;
  const Kind* kind = nullptr;
  for (const Kind& row : kinds) {
    if (row.urdf == from.type) kind = &row;
  }
  if (kind == nullptr) {
    problem = "joint \"" + from.name + "\" is neither fixed, revolute, continuous nor prismatic";
    return joint;
  }
  joint.kind = kind->kind;
  joint.parent_from_joint = pose_of(from.parent_to_joint_origin_transform);
  const Vector3d axis(from.axis.x, from.axis.y, from.axis.z);
  const bool moves = joint.kind != JointKind::fixed;
  if (!joint.parent_from_joint.vector().allFinite() || (moves && !(axis.norm() > 1e-9 && axis.allFinite()))) {
    problem = "joint \"" + from.name + "\" has an axis of no length, or a number that is not finite";
    return joint;
  }
  if (moves) joint.axis = axis.normalized();
  joint.limits = limits_of(from);
  if (moves && from.mimic) {
    joint.driver = from.mimic->joint_name;
    joint.multiplier = from.mimic->multiplier;
    joint.offset = from.mimic->offset;
  }
  return joint;
}

// A joint may mimic one that mimics: follow them to the one that is driven.
void resolve_mimics(Robot& robot, std::string& problem) {
  std::map<std::string, RobotJoint> by_name;
  for (const RobotJoint& joint : robot.joints) by_name[joint.name] = joint;
  for (RobotJoint& joint : robot.joints) {
    for (std::size_t step = 0; by_name.contains(joint.driver) && by_name[joint.driver].driver != joint.driver;
         ++step) {
      const RobotJoint& next = by_name[joint.driver];
      if (joint.driver == joint.name) break;
      joint.offset += joint.multiplier * next.offset;
      joint.multiplier *= next.multiplier;
      joint.driver = next.driver;
      if (step > robot.joints.size()) break;
    }
    const auto driver = by_name.find(joint.driver);
    const bool driven = driver != by_name.end() && driver->second.driver == joint.driver &&
                        driver->second.kind != JointKind::fixed;
    if (joint.kind != JointKind::fixed && !driven && problem.empty()) {
      problem = "joint \"" + joint.name + "\" mimics \"" + joint.driver +
                "\", which is no joint that moves by itself";
    }
  }
}

void add_children(Robot& robot, const urdf::Link& link, std::string& problem) {
  robot.links.push_back(link.name);
  std::ranges::move(shapes_of(link), std::back_inserter(robot.shapes));
  for (const auto& child : link.child_links) {
    robot.joints.push_back(joint_of(*child->parent_joint, problem));
    add_children(robot, *child, problem);
  }
}

}  // namespace

Result<Robot> read_urdf(std::string_view text, const std::string& name) {
  const auto wrong = [&](const std::string& what) {
    return Error{ErrorCode::unreadable, name + ": " + printable(what) + "; correct the URDF."};
  };
  // The parser would read past the end of a character that is cut off.
  if (const std::size_t at = first_not_utf8(text); at != std::string_view::npos)
    return wrong("byte " + std::to_string(at + 1) + " is not of UTF-8 text");
  if (too_deep(text)) return wrong("elements are nested more than " + std::to_string(deepest) + " deep");
  if (has_crowd_of_attributes(text))
    return wrong("an element has more than " + std::to_string(most_attributes) + " attributes");
  std::string problem = no_tree(std::string(text));
  if (!problem.empty()) return wrong(problem);
  const urdf::ModelInterfaceSharedPtr model = parsed(std::string(text), problem);
  if (!model || !model->getRoot())
    return wrong("this is no robot (" + (problem.empty() ? "no root link" : problem) + ")");
  if (model->links_.size() > most_links)
    return wrong("it has more than " + std::to_string(most_links) + " links");
  Robot robot{model->getName(), model->getRoot()->name, {}, {}, {}};
  add_children(robot, *model->getRoot(), problem);
  resolve_mimics(robot, problem);
  if (!problem.empty()) return wrong(problem);
  if (robot.links.size() != model->links_.size())
    return wrong("not every link hangs on the root \"" + robot.base + "\"");
  return robot;
}

}  // namespace patchlab
