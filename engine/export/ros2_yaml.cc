#include "engine/export/formats.h"
#include "engine/export/patch_messages.h"
#include "engine/export/text.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

// YAML 1.1, which ROS 2 reads, takes 1e-07 for a text: a point makes it a number.
std::string yaml_number(double value) {
  std::string text = decimal(value);
  if (text.find('.') != std::string::npos) return text;
  const std::size_t exponent = text.find('e');
  return exponent == std::string::npos ? text + ".0" : text.insert(exponent, ".0");
}

std::string flow(const ordered_json& value) {
  if (value.is_number_float()) return yaml_number(value.get<double>());
  if (!value.is_structured()) return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  std::string text, between;
  for (const auto& [key, element] : value.items()) {
    text += between + (value.is_object() ? key + ": " : "") + flow(element);
    between = ", ";
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

bool is_flat(const ordered_json& value) {
  for (const ordered_json& element : value) {
    if (element.is_structured()) return false;
  }
  return true;
}

// Mappings and sequences in blocks, those of plain values on one line.
void append_yaml(std::string& text, const ordered_json& value, std::size_t indent) {
  const std::string margin(indent, ' ');
  for (const auto& [key, element] : value.items()) {
    text += margin + (value.is_object() ? key + ":" : "-");
    if (!element.is_structured() || is_flat(element)) {
      text += " " + flow(element) + "\n";
    } else {
      text += "\n";
      append_yaml(text, element, indent + 2);
    }
  }
}

std::string ros2_type(std::string_view type) {
  const std::size_t slash = type.find('/');
  return std::string(type.substr(0, slash)) + "/msg" + std::string(type.substr(slash));
}

// "p0_ball.pose.yaml"
ExportedFile yaml_file(const RosMessage& message, const std::string& name) {
  std::string text = "# ros2 topic pub --once " + message.topic + " " + ros2_type(message.type) +
                     " \"$(cat " + name + ")\"\n";
  if (message.type.ends_with("PoseWithCovarianceStamped"))
    text += "# covariance: of position, then rotation about fixed parent axes, row by row\n";
  append_yaml(text, message.value, 0);
  return {name, std::move(text)};
}

}  // namespace

Result<Exported> export_ros2_yaml(const PatchSet& set, const ExportOptions&) {
  constexpr int cells = 8;  // so that each file fits an argument of a command, 128 kB
  Result<PatchMessages> messages = patch_messages(set, {}, cells);
  if (!messages) return messages.error();
  Exported out{{}, std::move(messages->notices)};
  for (std::size_t i = 0; i < set.patches.size(); ++i)
    out.files.push_back(yaml_file(messages->markers[i], plain_name(set.patches[i].id, i) + ".markers.yaml"));
  for (const std::vector<RosMessage>* list : {&messages->poses, &messages->points}) {
    for (const RosMessage& message : *list) {
      std::string name = message.topic.substr(std::string_view("/patches/").size()) + ".yaml";
      name[name.rfind('/')] = '.';
      out.files.push_back(yaml_file(message, name));
    }
  }
  return out;
}

}  // namespace patchlab
