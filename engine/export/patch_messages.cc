#include "engine/export/patch_messages.h"

#include <algorithm>
#include <map>

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
constexpr int marker_resolution = 16, cloud_resolution = 8;

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

ordered_json surface_marker(const PatchRecord& record) {
  const Pose pose = world_from_patch(record.patch);
  ordered_json out = marker(record, 0, triangle_list, pose_of(pose.r, pose.t), Vector3d::Ones(),
                            colour(0.27, 0.55, 0.85, 0.85));
  const Triangles mesh = open_surface(record.patch, marker_resolution);
  ordered_json points = ordered_json::array();
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t corner : face) points.push_back(xyz(mesh.points[corner]));
  }
  out["points"] = std::move(points);
  return out;
}

ordered_json outline_marker(const PatchRecord& record) {
  const Pose pose = world_from_patch(record.patch);
  ordered_json out = marker(record, 1, line_strip, pose_of(pose.r, pose.t), {line_width, 0.0, 0.0},
                            colour(0.95, 0.95, 0.95, 1.0));
  ordered_json points = ordered_json::array();
  for (const Vector2d& u : outline(boundary(record.patch), 128))
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

// The points of one frame, in the bytes of a PointCloud2.
class Cloud {
 public:
  void add(const Patch& patch, std::uint32_t number) {
    const Triangles mesh = open_surface(patch, cloud_resolution);
    const Matrix3d R = axes(patch);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const Vector3d q = R * mesh.points[i] + centre(patch),
                     n = height_sigma(patch, mesh.u[i]) * (R * mesh.normals[i]);
      for (const double value : {q.x(), q.y(), q.z(), n.x() * n.x(), n.x() * n.y(), n.x() * n.z(),
                                 n.y() * n.y(), n.y() * n.z(), n.z() * n.z()})
        append_bytes(bytes_, static_cast<float>(value));
      append_bytes(bytes_, number);
      ++count_;
    }
  }

  ordered_json message(const std::string& frame) const {
    ordered_json fields = ordered_json::array();
    std::uint32_t offset = 0;
    for (const char* name :
         {"x", "y", "z", "cov_xx", "cov_xy", "cov_xz", "cov_yy", "cov_yz", "cov_zz", "patch"}) {
      const bool last = std::string_view(name) == "patch";
      fields.push_back({{"name", name},
                        {"offset", offset},
                        {"datatype", static_cast<int>(last ? field_uint32 : field_float32)},
                        {"count", 1}});
      offset += 4;
    }
    ordered_json data = ordered_json::array();
    for (const char byte : bytes_) data.push_back(static_cast<std::uint8_t>(byte));
    return {{"header", header_in(frame)},
            {"height", 1},
            {"width", count_},
            {"fields", fields},
            {"is_bigendian", false},
            {"point_step", offset},
            {"row_step", offset * count_},
            {"data", std::move(data)},
            {"is_dense", true}};
  }

 private:
  std::string bytes_;
  std::uint32_t count_ = 0;
};

}  // namespace

Result<PatchMessages> patch_messages(const PatchSet& set) {
  PatchMessages out;
  ordered_json markers = {{{"action", delete_all}}};
  std::map<std::string, Cloud> clouds;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const PatchRecord& record = set.patches[i];
    if (record.frame_id.empty()) {
      return Error{ErrorCode::refused,
                   "patch \"" + record.id +
                       "\": names no frame_id, which every ROS message needs. Nothing was written."};
    }
    markers.push_back(surface_marker(record));
    markers.push_back(outline_marker(record));
    if (!record.patch.covariance_local) {
      out.notices.push_back("patch \"" + record.id +
                            "\": has no covariance, so its pose, ellipsoid and points were left out.");
      continue;
    }
    markers.push_back(ellipsoid_marker(record));
    out.poses.push_back({"/patches/" + plain_name(record.id, i) + "/pose",
                         "geometry_msgs/PoseWithCovarianceStamped", pose_with_covariance(record)});
    clouds[record.frame_id].add(record.patch, static_cast<std::uint32_t>(i));
  }
  out.markers = {"/patches", "visualization_msgs/MarkerArray", {{"markers", std::move(markers)}}};
  for (const auto& [frame, cloud] : clouds) {
    out.points.push_back({"/patches/" + plain_name(frame, out.points.size()) + "/points",
                          "sensor_msgs/PointCloud2", cloud.message(frame)});
  }
  return out;
}

}  // namespace patchlab
