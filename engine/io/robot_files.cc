#include "engine/io/robot_files.h"

#include <cmath>
#include <optional>
#include <set>

#include "engine/io/json.h"
#include "engine/io/patch_json.h"
#include "engine/io/read_error.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

double standard_deviation(const JsonPlace& place) {
  const double sigma = place.number();
  if (place.ok() && sigma < 0.0) place.fail("is negative");
  return sigma;
}

JointFile joints_from_json(const JsonPlace& root) {
  JointFile file;
  const JsonPlace joints = root["joints"];
  if (root.ok() && !joints.value().is_object()) joints.fail("is no object of joints");
  if (!root.ok()) return file;
  for (const auto& [name, value] : joints.value().items()) {
    const JsonPlace joint = joints[name];
    const auto sigma = joint.find("sigma");
    file.values[name] = {joint["value"].number(), sigma ? standard_deviation(*sigma) : 0.0};
  }
  if (const auto base = root.find("base_in")) file.base_in = base->text();
  if (const auto tolerance = root.find("link_tolerance")) {
    tolerance->only({"rotation", "translation"});
    if (const auto rotation = tolerance->find("rotation"))
      file.tolerance.rotation = standard_deviation(*rotation);
    if (const auto translation = tolerance->find("translation"))
      file.tolerance.translation = standard_deviation(*translation);
  }
  return file;
}

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t at = text.find(mark);
    out.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return out;
    text.remove_prefix(at + 1);
  }
}

bool finite_number(std::string_view cell, double& value) {
  const std::optional<double> number = parse_number<double>(trimmed(cell));
  value = number.value_or(0.0);
  return number && std::isfinite(value);
}

// One row "joint,value[,sigma]"; what is wrong with it, or nothing.
std::string add_row(std::string_view line, JointValues& values) {
  const std::vector<std::string_view> cells = split(line, ',');
  const std::string joint(trimmed(cells[0]));
  if (cells.size() < 2 || cells.size() > 3 || joint.empty()) return "needs a joint, its value and its sigma";
  JointValue value;
  if (!finite_number(cells[1], value.value)) return shown(cells[1]) + " is no finite number";
  const std::string_view sigma = cells.size() == 3 ? trimmed(cells[2]) : std::string_view();
  if (!sigma.empty() && (!finite_number(sigma, value.sigma) || value.sigma < 0.0))
    return shown(sigma) + " is no standard deviation";
  if (!values.emplace(joint, value).second) return "names joint " + shown(joint) + " again";
  return {};
}

Result<JointFile> joints_from_csv(std::string_view text, const std::string& name) {
  JointFile file;
  std::size_t number = 0;
  for (const std::string_view raw : split(text, '\n')) {
    const std::string_view line = trimmed(raw);
    ++number;
    if (line.empty()) continue;
    if (number == 1) {
      if (line != "joint,value,sigma" && line != "joint,value")
        return unreadable_line(name, 1, "the header must be joint,value,sigma.");
      continue;
    }
    if (const std::string problem = add_row(line, file.values); !problem.empty())
      return unreadable_line(name, number, problem + ".");
  }
  return file;
}

RobotPatch robot_patch_from_json(const JsonPlace& unnamed) {
  RobotPatch out;
  out.id = unnamed["id"].text();
  const JsonPlace place = unnamed.called("patch \"" + out.id + "\"");
  out.link = place["link"].text();
  out.patch = patch_from_json(place);
  return out;
}

}  // namespace

Result<JointFile> read_joints(std::string_view text, const std::string& name) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{') return joints_from_csv(text, name);
  const Result<nlohmann::json> json = parse_json(text, name);
  if (!json) return json.error();
  std::optional<Error> error;
  const JointFile file = joints_from_json(JsonPlace(*json, name, error));
  if (error) return *error;
  return file;
}

Result<std::vector<RobotPatch>> read_robot_patches(std::string_view text, const std::string& name) {
  const Result<nlohmann::json> json = parse_json(text, name);
  if (!json) return json.error();
  std::optional<Error> error;
  const JsonPlace root(*json, name, error);
  const JsonPlace format = root["format"], version = root["version"];
  if (format.text() != "patchlab.robot_patches") format.fail("is not \"patchlab.robot_patches\"");
  if (version.number() >= 2.0)
    version.fail(version.value().dump() +
                 " is newer than this program, which reads version 1; use a newer patchlab");
  std::vector<RobotPatch> out;
  std::set<std::string> ids;
  for (const JsonPlace& place : root["patches"].items()) {
    out.push_back(robot_patch_from_json(place));
    if (!ids.insert(out.back().id).second) place["id"].fail("is taken by an earlier patch");
  }
  if (error) return *error;
  return out;
}

}  // namespace patchlab
