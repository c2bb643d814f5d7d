#include "engine/map/urdf_parts.h"

#include <urdf_model/joint.h>
#include <urdf_model/link.h>

#include <cmath>

namespace patchlab {
namespace {

Vector3d vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

std::optional<LinkShape> shape_of(const urdf::Geometry* geometry, const urdf::Pose& origin) {
  LinkShape shape;
  if (const auto* box = dynamic_cast<const urdf::Box*>(geometry)) {
    shape.size = vector(box->dim);
  } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(geometry)) {
    shape.kind = LinkShapeKind::cylinder;
    shape.size = {cylinder->radius, cylinder->radius, cylinder->length};
  } else if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(geometry)) {
    shape.kind = LinkShapeKind::sphere;
    shape.size = Vector3d::Constant(sphere->radius);
  } else if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(geometry)) {
    shape.kind = LinkShapeKind::mesh;
    shape.size = vector(mesh->scale);
    shape.file = mesh->filename;
  } else {
    return std::nullopt;
  }
  shape.link_from_shape = pose_of(origin);
  const bool has_size = shape.size.allFinite() && (shape.size.array().abs() > 0.0).all();
  const bool is_placed = shape.link_from_shape.vector().allFinite();
  if (!has_size || !is_placed) return std::nullopt;
  return shape;
}

template <class Parts>
std::vector<LinkShape> shapes_in(const Parts& parts, const std::string& link) {
  std::vector<LinkShape> shapes;
  for (const auto& part : parts) {
    std::optional<LinkShape> shape = shape_of(part->geometry.get(), part->origin);
    if (!shape) continue;
    shape->link = link;
    shapes.push_back(*shape);
  }
  return shapes;
}

}  // namespace

Pose pose_of(const urdf::Pose& pose) {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  pose.rotation.getQuaternion(x, y, z, w);
  const Eigen::Vector4d q = Eigen::Vector4d(x, y, z, w).normalized();
  const Vector3d v = q.head<3>();
  // R of the unit quaternion (v, w).
  const Matrix3d R =
      (2.0 * q[3] * q[3] - 1.0) * Matrix3d::Identity() + 2.0 * (v * v.transpose() + q[3] * skew(v));
  return {log_map(R), vector(pose.position)};
}

std::optional<JointLimits> limits_of(const urdf::Joint& joint) {
  if (joint.type == urdf::Joint::CONTINUOUS || !joint.limits) return std::nullopt;
  const JointLimits limits{joint.limits->lower, joint.limits->upper};
  const bool hold = std::isfinite(limits.lower) && std::isfinite(limits.upper) && limits.lower < limits.upper;
  return hold ? std::optional(limits) : std::nullopt;
}

std::vector<LinkShape> shapes_of(const urdf::Link& link) {
  std::vector<LinkShape> shapes = shapes_in(link.visual_array, link.name);
  return shapes.empty() ? shapes_in(link.collision_array, link.name) : shapes;
}

}  // namespace patchlab
