#include "engine/export/ros_message.h"

#include <algorithm>
#include <cstdint>
#include <sstream>

#include "engine/export/text.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

struct Definition {
  std::string_view type, md5, fields;  // md5: of types that are sent as they are
};

constexpr Definition definitions[] = {
    {"visualization_msgs/MarkerArray", "d155b9ce5188fbaf89745847fd5882d7", "Marker[] markers\n"},
    {"geometry_msgs/PoseWithCovarianceStamped", "953b798c0f514ff060a53a3498ce6246",
     "Header header\nPoseWithCovariance pose\n"},
    {"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181",
     "Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\nuint32 point_step\n"
     "uint32 row_step\nuint8[] data\nbool is_dense\n"},
    {"visualization_msgs/Marker", "",
     "uint8 ARROW=0\nuint8 CUBE=1\nuint8 SPHERE=2\nuint8 CYLINDER=3\nuint8 LINE_STRIP=4\nuint8 LINE_LIST=5\n"
     "uint8 CUBE_LIST=6\nuint8 SPHERE_LIST=7\nuint8 POINTS=8\nuint8 TEXT_VIEW_FACING=9\nuint8 MESH_RESOURCE=10\n"
     "uint8 TRIANGLE_LIST=11\nuint8 ADD=0\nuint8 MODIFY=0\nuint8 DELETE=2\nuint8 DELETEALL=3\n"
     "Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n"
     "geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nduration lifetime\nbool frame_locked\n"
     "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring text\nstring mesh_resource\n"
     "bool mesh_use_embedded_materials\n"},
    {"geometry_msgs/PoseWithCovariance", "", "Pose pose\nfloat64[36] covariance\n"},
    {"sensor_msgs/PointField", "",
     "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\nuint8 FLOAT32=7\n"
     "uint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n"},
    {"geometry_msgs/Pose", "", "Point position\nQuaternion orientation\n"},
    {"geometry_msgs/Point", "", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"std_msgs/ColorRGBA", "", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    {"std_msgs/Header", "", "uint32 seq\ntime stamp\nstring frame_id\n"},
};

const Definition* find_definition(std::string_view type) {
  const auto found = std::ranges::find(definitions, type, &Definition::type);
  return found == std::end(definitions) ? nullptr : &*found;
}

struct MessageField {
  std::string type, name;  // the type in full
  bool array = false;
  std::size_t count = 0;  // of an array of fixed size; 0: it says its own
};

MessageField parsed_field(std::string type, const std::string& name, const Definition& within) {
  MessageField field{"", name};
  if (const std::size_t bracket = type.find('['); bracket != std::string::npos) {
    field.array = true;
    if (type[bracket + 1] != ']') field.count = std::stoul(type.substr(bracket + 1));
    type.resize(bracket);
  }
  const std::string beside = std::string(within.type.substr(0, within.type.find('/') + 1)) + type;
  field.type = type == "Header" ? "std_msgs/Header" : find_definition(beside) ? beside : type;
  return field;
}

std::vector<MessageField> fields_of(const Definition& definition) {
  std::vector<MessageField> fields;
  std::istringstream lines{std::string(definition.fields)};
  for (std::string type, name; lines >> type >> name;) {
    if (name.find('=') == std::string::npos) fields.push_back(parsed_field(type, name, definition));
  }
  return fields;
}

void append_value(std::string& bytes, const std::string& type, const ordered_json& value);

template <class T>
void append_number(std::string& bytes, const ordered_json& value) {
  append_bytes(bytes, value.is_null() ? T{} : static_cast<T>(value.get<double>()));
}
void append_truth(std::string& bytes, const ordered_json& value) {
  append_bytes(bytes, static_cast<std::uint8_t>(!value.is_null() && value.get<bool>()));
}
void append_text(std::string& bytes, const ordered_json& value) {
  const std::string text = value.is_null() ? "" : value.get<std::string>();
  append_bytes(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}
// Stamps and lifetimes are zero: the latest transform, and for good.
void append_zero_time(std::string& bytes, const ordered_json&) { append_bytes(bytes, std::uint64_t{0}); }

struct Builtin {
  std::string_view type;
  void (*append)(std::string& bytes, const ordered_json& value);
};
constexpr Builtin builtins[] = {
    {"bool", append_truth},
    {"uint8", append_number<std::uint8_t>},
    {"int32", append_number<std::int32_t>},
    {"uint32", append_number<std::uint32_t>},
    {"float32", append_number<float>},
    {"float64", append_number<double>},
    {"string", append_text},
    {"time", append_zero_time},
    {"duration", append_zero_time},
};

void append_array(std::string& bytes, const MessageField& field, const ordered_json& value) {
  const std::size_t count = field.count > 0 ? field.count : value.size();
  if (field.count == 0) append_bytes(bytes, static_cast<std::uint32_t>(count));
  for (std::size_t i = 0; i < count; ++i)
    append_value(bytes, field.type, i < value.size() ? value[i] : ordered_json());
}

void append_value(std::string& bytes, const std::string& type, const ordered_json& value) {
  const auto builtin = std::ranges::find(builtins, type, &Builtin::type);
  if (builtin != std::end(builtins)) return builtin->append(bytes, value);
  for (const MessageField& field : fields_of(*find_definition(type))) {
    const ordered_json member =
        value.is_object() && value.contains(field.name) ? value[field.name] : ordered_json();
    field.array ? append_array(bytes, field, member) : append_value(bytes, field.type, member);
  }
}

void collect_types(const Definition& definition, std::vector<const Definition*>& found) {
  for (const MessageField& field : fields_of(definition)) {
    const Definition* const inner = find_definition(field.type);
    if (!inner || std::ranges::count(found, inner) > 0) continue;
    found.push_back(inner);
    collect_types(*inner, found);
  }
}

}  // namespace

std::string_view ros1_md5(std::string_view type) { return find_definition(type)->md5; }

std::string ros1_definition(std::string_view type) {
  const Definition& top = *find_definition(type);
  std::vector<const Definition*> inner;
  collect_types(top, inner);
  std::string text(top.fields);
  for (const Definition* definition : inner)
    text += std::string(80, '=') + "\nMSG: " + std::string(definition->type) + "\n" +
            std::string(definition->fields);
  return text;
}

std::string ros1_bytes(const RosMessage& message) {
  std::string bytes;
  append_value(bytes, std::string(message.type), message.value);
  return bytes;
}

}  // namespace patchlab
