#include "engine/io/patch_json.h"

#include <cmath>

#include "engine/io/pose_covariance.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

template <class Vector>
ordered_json vector_json(const Vector& vector) {
  ordered_json array = ordered_json::array();
  for (const double x : vector) array.push_back(x);
  return array;
}

template <class Matrix>
ordered_json matrix_json(const Matrix& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(vector_json(matrix.row(i)));
  return rows;
}

ordered_json pose_json(const Patch& patch) {
  const Pose pose = world_from_patch(patch);
  ordered_json object;
  object["position"] = vector_json(pose.t);
  object["quaternion_xyzw"] = quaternion_xyzw(pose.r);
  if (patch.covariance_local) object["covariance_ros"] = matrix_json(ros_fixed_axes_covariance(patch));
  return object;
}

const PatchTypeRow* type_from_json(const JsonPlace& place) {
  const JsonPlace surface_place = place["surface"], boundary_place = place["boundary"];
  const std::string surface_name = surface_place.text(), boundary_name = boundary_place.text();
  const std::optional<SurfaceType> surface = surface_from_name(surface_name);
  const std::optional<BoundaryType> boundary = boundary_from_name(boundary_name);
  if (!surface) surface_place.fail("\"" + surface_name + "\" is not a surface that patchlab knows");
  if (!boundary) boundary_place.fail("\"" + boundary_name + "\" is not a boundary that patchlab knows");
  if (!surface || !boundary) return nullptr;
  const PatchTypeRow* type = find_patch_type(*surface, *boundary);
  if (!type) {
    place.fail("pairs the surface " + surface_name + " with the boundary " + boundary_name +
               ", which is none of the ten patch types");
  }
  return type;
}

void check_names(const JsonPlace& place, const std::vector<std::string>& expected) {
  std::vector<std::string> names;
  for (const JsonPlace& item : place.items()) names.push_back(item.text());
  if (names == expected) return;
  std::string list;
  for (const std::string& name : expected) list += (list.empty() ? "" : " ") + name;
  place.fail("differ from the parameters of this type, which are " + list);
}

}  // namespace

Patch patch_from_json(const JsonPlace& place) {
  Patch patch;
  patch.type = type_from_json(place);
  if (!patch.type) return patch;
  const int size = patch.type->size();
  const JsonPlace parameters = place["parameters"];
  check_names(parameters["names"], parameter_names(*patch.type));
  patch.parameters = parameters["values"].numbers(size);
  if (const auto covariance = place.find("covariance")) patch.covariance = covariance->square_matrix(size);
  if (const auto local = place.find("covariance_local")) {
    check_names((*local)["names"], local_names(*patch.type));
    patch.covariance_local = (*local)["values"].square_matrix(size);
  }
  if (const Result<void> valid = validate(patch); !valid) place.fail("cannot be: " + valid.error().message);
  if (place.ok()) patch.covariance_local = local_covariance(patch);
  return patch;
}

void append_patch(ordered_json& object, const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  object["surface"] = name(type.surface);
  object["boundary"] = name(type.boundary);
  object["parameters"] = {{"names", parameter_names(type)}, {"values", vector_json(patch.parameters)}};
  object["covariance"] = patch.covariance ? matrix_json(*patch.covariance) : ordered_json(nullptr);
  if (patch.covariance_local) {
    object["covariance_local"] = {{"names", local_names(type)},
                                  {"values", matrix_json(*patch.covariance_local)}};
    object["near_singular"] = near_singular(patch);
  }
  object["spin_observable"] = !type.revolute();
  object["pose"] = pose_json(patch);
}

std::array<double, 4> quaternion_xyzw(const Vector3d& r) {
  const double angle = r.stableNorm();
  const double scale = angle > 0.0 ? std::sin(0.5 * angle) / angle : 0.5;
  return {scale * r.x(), scale * r.y(), scale * r.z(), std::cos(0.5 * angle)};
}

ordered_json viewpoint_to_json(const Viewpoint& viewpoint) {
  return {{"position", vector_json(viewpoint.position)},
          {"quaternion_xyzw", viewpoint.quaternion_xyzw},
          {"stated", viewpoint.stated}};
}

Viewpoint viewpoint_from_json(const JsonPlace& place) {
  Viewpoint viewpoint;
  viewpoint.position = place["position"].numbers(3);
  const JsonPlace quaternion_place = place["quaternion_xyzw"];
  const Eigen::Vector4d quaternion = quaternion_place.numbers(4);
  if (std::abs(quaternion.norm() - 1.0) > 1e-3)
    quaternion_place.fail("is not of length 1, so it is no rotation");
  Eigen::Vector4d::Map(viewpoint.quaternion_xyzw.data()) = quaternion;
  const std::optional<JsonPlace> stated = place.find("stated");
  viewpoint.stated = !stated || stated->boolean();
  return viewpoint;
}

}  // namespace patchlab
