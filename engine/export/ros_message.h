// ROS messages as trees of JSON, and their bytes on the wire of ROS 1. Members that a tree lacks are zero or
// empty.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace patchlab {

struct RosMessage {
  std::string topic;
  std::string_view type;  // "visualization_msgs/MarkerArray"
  nlohmann::ordered_json value;
};

// Of the types that are sent as they are.
std::string_view ros1_md5(std::string_view type);
// The definition followed by those of all types in it, as bags carry it.
std::string ros1_definition(std::string_view type);
std::string ros1_bytes(const RosMessage& message);

}  // namespace patchlab
