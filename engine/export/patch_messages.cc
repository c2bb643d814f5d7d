#include "engine/export/patch_messages.h"

#include <algorithm>

#include "engine/export/text.h"
#include "engine/export/triangles.h"
#include "engine/io/patch_json.h"
#include "engine/io/pose_covariance.h"
#include "engine/mesh/patch_mesh.h"
#include "engine/patch/marginals.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

enum MarkerKind { sphere_marker = 2, line_strip = 4, triangle_list = 11 };
constexpr int delete_all = 3;
enum PointFieldType { field_uint32 = 6, field_float32 = 7 };

constexpr double probability = 0.95;
constexpr double line_width = 0.002;     // m
constexpr double least_diameter = 1e-6;  // m; a marker of no size is an error to RViz
constexpr int cloud_cells = 8;

ordered_json xyz(const Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

ordered_json pose_of(const Vector3d& r, const Vector3d& t) {
  const auto [x, y, z, w] = quaternion_xyzw(r);
  return {{"position", xyz(t)}, {"orientation", {{"x", x}, {"y", y}, {"z", z}, {"w", w}}}};
}

ordered_json header_in(const std::string& frame) { return {{"frame_id", frame}}; }

ordered_json colour(double r, double g, double b, double a) {
  return {{"r", r}, {"g", g}, {"b", b}, {"a", a}};
}

ordered_json marker(const PatchRecord& record, int id, MarkerKind kind, const ordered_json& pose,
                    const Vector3d& scale, const ordered_json& shade) {
  return {{"header", header_in(record.frame_id)},
          {"ns", record.id},
          {"id", id},
          {"type", static_cast<int>(kind)},
          {"action", 0},
          {"pose", pose},
          {"scale", xyz(scale)},
          {"color", shade},
          {"frame_locked", false}};
}

ordered_json surface_marker(const PatchRecord& record, int cells) {
  const Pose pose = world_from_patch(record.patch);
  ordered_json out = marker(record, 0, triangle_list, pose_of(pose.r, pose.t), Vector3d::Ones(),
                            colour(0.27, 0.55, 0.85, 0.85));
  const Triangles mesh = open_surface(record.patch, cells);
  ordered_json points = ordered_json::array();
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t corner : face) points.push_back(xyz(mesh.points[corner]));
  }
  out["points"] = std::move(points);
  return out;
}

ordered_json outline_marker(const PatchRecord& record, int cells) {
  const Pose pose = world_from_patch(record.patch);
  ordered_json out = marker(record, 1, line_strip, pose_of(pose.r, pose.t), {line_width, 0.0, 0.0},
                            colour(0.95, 0.95, 0.95, 1.0));
  ordered_json points = ordered_json::array();
  for (const Vector2d& u : outline(boundary(record.patch), 8 * cells))
    points.push_back(xyz(surface_point(u, k3(record.patch))));
  points.push_back(ordered_json(points.front()));
  out["points"] = std::move(points);
  return out;
}

ordered_json ellipsoid_marker(const PatchRecord& record) {
  const Ellipsoid shape = centre_ellipsoid(record.patch, probability);
  const Vector3d diameters = (2.0 * shape.half_lengths).cwiseMax(least_diameter);
  return marker(record, 2, sphere_marker, pose_of(log_map(shape.axes), shape.centre), diameters,
                colour(0.95, 0.65, 0.2, 0.6));
}

ordered_json pose_with_covariance(const PatchRecord& record) {
  const Pose pose = world_from_patch(record.patch);
  const Matrix6d cov = ros_fixed_axes_covariance(record.patch);
  ordered_json covariance = ordered_json::array();
  for (const double entry : cov.reshaped<Eigen::RowMajor>()) covariance.push_back(entry);
  return {{"header", header_in(record.frame_id)},
          {"pose", {{"pose", pose_of(pose.r, pose.t)}, {"covariance", std::move(covariance)}}}};
}

constexpr std::string_view cloud_fields[] = {"x",      "y",      "z",      "cov_xx", "cov_xy",
                                             "cov_xz", "cov_yy", "cov_yz", "cov_zz", "patch"};

ordered_json field_messages() {
  ordered_json fields = ordered_json::array();
  for (const std::string_view name : cloud_fields) {
    fields.push_back({{"name", name},
                      {"offset", 4 * fields.size()},
                      {"datatype", static_cast<int>(name == "patch" ? field_uint32 : field_float32)},
                      {"count", 1}});
  }
  return fields;
}

// Points of the surface, each known as well as its height.
Observations surface_points(const Patch& patch) {
  const Triangles mesh = open_surface(patch, cloud_cells);
  const Matrix3d R = axes(patch);
  Observations out;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector3d n = height_sigma(patch, mesh.u[i]) * (R * mesh.normals[i]);
    out.points.push_back(R * mesh.points[i] + centre(patch));
    out.covariances.push_back(n * n.transpose());
  }
  return out;
}

ordered_json cloud_message(const PatchRecord& record, std::uint32_t number, const Observations& cloud) {
  std::string bytes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3d& q = cloud.points[i];
    const Matrix3d& cov = cloud.covariances[i];
    for (const double value :
         {q.x(), q.y(), q.z(), cov(0, 0), cov(0, 1), cov(0, 2), cov(1, 1), cov(1, 2), cov(2, 2)})
      append_bytes(bytes, static_cast<float>(value));
    append_bytes(bytes, number);
  }
  ordered_json data = ordered_json::array();
  for (const char byte : bytes) data.push_back(static_cast<std::uint8_t>(byte));
  return {{"header", header_in(record.frame_id)},
          {"height", 1},
          {"width", cloud.size()},
          {"fields", field_messages()},
          {"is_bigendian", false},
          {"point_step", 4 * std::size(cloud_fields)},
          {"row_step", bytes.size()},
          {"data", std::move(data)},
          {"is_dense", true}};
}

}  // namespace

Result<PatchMessages> patch_messages(const PatchSet& set, const std::map<std::string, Observations>& measured,
                                     int cells) {
  PatchMessages out;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const PatchRecord& record = set.patches[i];
    if (record.frame_id.empty()) {
      return Error{ErrorCode::refused,
                   "patch \"" + record.id +
                       "\": names no frame_id, which every ROS message needs. Nothing was "
                       "written."};
    }
    const std::string topic = "/patches/" + plain_name(record.id, i);
    ordered_json markers = {surface_marker(record, cells), outline_marker(record, cells)};
    if (record.patch.covariance_local) {
      markers.push_back(ellipsoid_marker(record));
      out.poses.push_back(
          {topic + "/pose", "geometry_msgs/PoseWithCovarianceStamped", pose_with_covariance(record)});
      const auto at_hand = measured.find(record.id);
      out.points.push_back(
          {topic + "/points", "sensor_msgs/PointCloud2",
           cloud_message(record, static_cast<std::uint32_t>(i),
                         at_hand == measured.end() ? surface_points(record.patch) : at_hand->second)});
    } else {
      out.notices.push_back("patch \"" + record.id +
                            "\": has no covariance, so its pose, ellipsoid and points were left out.");
    }
    out.markers.push_back({"/patches", "visualization_msgs/MarkerArray", {{"markers", std::move(markers)}}});
  }
  return out;
}

RosMessage all_markers(const PatchMessages& messages) {
  ordered_json markers = {{{"action", delete_all}}};
  for (const RosMessage& message : messages.markers) {
    for (const ordered_json& marker : message.value["markers"]) markers.push_back(marker);
  }
  return {"/patches", "visualization_msgs/MarkerArray", {{"markers", std::move(markers)}}};
}

}  // namespace patchlab
