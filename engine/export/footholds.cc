#include <cmath>

#include "engine/export/foothold.h"
#include "engine/export/formats.h"
#include "engine/export/text.h"
#include "engine/io/json.h"
#include "engine/io/patch_json.h"
#include "engine/map/queries.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

constexpr double largest_departure = 0.01;  // m, of a patch that passes for a plane

struct Standing {
  std::vector<Vector2d> polygon;
  std::string reason;  // why there is none
};

Standing standing(const PatchRecord& record, const ExportOptions& options) {
  if (!record.patch.covariance_local && options.inset_sigmas > 0.0)
    return {
        {},
        "has no covariance, so how far its outline is off is unknown; inset by 0 standard deviations to take it as exact"};
  Standing out{inner_polygon(record.patch, options.inset_sigmas, options.foot_radius), {}};
  if (out.polygon.empty()) out.reason = "is too small: nothing of it is left within the inset";
  return out;
}

std::string left_out(const PatchRecord& record, const std::string& reason) {
  return "patch \"" + record.id + "\": " + reason + "; it was left out.";
}

ordered_json points_json(const std::vector<Vector2d>& points) {
  ordered_json array = ordered_json::array();
  for (const Vector2d& point : points) array.push_back({point.x(), point.y()});
  return array;
}

ordered_json array_json(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ordered_json tilt_json(const Patch& patch, const ExportOptions& options) {
  const Estimate angle = tilt(patch, options.up);
  return {{"angle", angle.value},
          {"sigma", angle.sigma},
          {"probability_above_limit", tilt_exceeds(patch, options.up, options.tilt_limit)}};
}

ordered_json foothold_json(const PatchRecord& record, const std::vector<Vector2d>& polygon,
                           const ExportOptions& options) {
  const Patch& patch = record.patch;
  const Vector3d k = k3(patch);
  const Vector2d range = height_range(patch, polygon);
  return {{"patch", record.id},
          {"frame_id", record.frame_id},
          {"surface", name(patch.type->surface)},
          {"pose",
           {{"position", array_json(centre(patch))},
            {"quaternion_xyzw", quaternion_xyzw(world_from_patch(patch).r)}}},
          {"normal", array_json(axes(patch).col(2))},
          {"curvature_x", k.x()},
          {"curvature_y", k.y()},
          {"polygon", points_json(polygon)},
          {"area", polygon_area(polygon)},
          {"height_range", {range[0], range[1]}},
          {"tilt", tilt_json(patch, options)}};
}

ordered_json point_message(const Vector2d& point) { return {{"x", point.x()}, {"y", point.y()}}; }

ordered_json polygon_message(const std::vector<Vector2d>& polygon) {
  ordered_json points = ordered_json::array();
  for (const Vector2d& point : polygon) points.push_back(point_message(point));
  return {{"outer_boundary", {{"points", points}}}, {"holes", ordered_json::array()}};
}

ordered_json pose_message(const Patch& patch) {
  const Vector3d c = centre(patch);
  const auto [x, y, z, w] = quaternion_xyzw(world_from_patch(patch).r);
  return {{"position", {{"x", c.x()}, {"y", c.y()}, {"z", c.z()}}},
          {"orientation", {{"x", x}, {"y", y}, {"z", z}, {"w", w}}}};
}

ordered_json region_message(const Patch& patch, const std::vector<Vector2d>& polygon) {
  const std::vector<Vector2d> whole = inner_polygon(patch, 0.0, 0.0);
  Vector2d low = whole.front(), high = low;
  for (const Vector2d& point : whole) low = low.cwiseMin(point), high = high.cwiseMax(point);
  return {{"plane_parameters", pose_message(patch)},
          {"bbox2d", {{"min_x", low.x()}, {"min_y", low.y()}, {"max_x", high.x()}, {"max_y", high.y()}}},
          {"boundary", polygon_message(whole)},
          {"insets", {polygon_message(polygon)}}};
}

}  // namespace

Result<Exported> export_footholds(const PatchSet& set, const ExportOptions& options) {
  Exported out;
  ordered_json footholds = ordered_json::array();
  for (const PatchRecord& record : set.patches) {
    const auto [polygon, reason] = standing(record, options);
    if (reason.empty())
      footholds.push_back(foothold_json(record, polygon, options));
    else
      out.notices.push_back(left_out(record, reason));
  }
  const ordered_json document = {{"format", "patchlab.footholds"},
                                 {"version", 1},
                                 {"units", {{"length", "m"}, {"angle", "rad"}}},
                                 {"inset_sigmas", options.inset_sigmas},
                                 {"foot_radius", options.foot_radius},
                                 {"up", array_json(options.up)},
                                 {"tilt_limit", options.tilt_limit},
                                 {"footholds", footholds}};
  Result<std::string> text = json_text(document, "footholds");
  if (!text) return text.error();
  out.files.push_back({"", std::move(*text)});
  return out;
}

Result<Exported> export_planar_regions(const PatchSet& set, const ExportOptions& options) {
  const Result<std::string> frame = common_frame(set, "planar_regions");
  if (!frame) return frame.error();
  Exported out;
  ordered_json regions = ordered_json::array(), ids = ordered_json::array();
  for (const PatchRecord& record : set.patches) {
    auto [polygon, reason] = standing(record, options);
    const Vector2d range = height_range(record.patch, inner_polygon(record.patch, 0.0, 0.0));
    if (range[1] - range[0] > largest_departure)
      reason =
          "is curved: it leaves its plane by " + decimal(std::round(1e3 * (range[1] - range[0]))) + " mm";
    if (reason.empty()) {
      regions.push_back(region_message(record.patch, polygon));
      ids.push_back(record.id);
    } else {
      out.notices.push_back(left_out(record, reason));
    }
  }
  const ordered_json document = {{"frame_id", *frame}, {"patches", ids}, {"planarRegions", regions}};
  Result<std::string> text = json_text(document, "planar regions");
  if (!text) return text.error();
  out.files.push_back({"", std::move(*text)});
  return out;
}

}  // namespace patchlab
