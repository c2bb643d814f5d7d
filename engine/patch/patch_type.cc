#include "engine/patch/patch_type.h"

#include <algorithm>
#include <array>

namespace patchlab {
namespace {

using Selection = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2>;  // B

Selection none() { return Selection(3, 0); }
Selection one(double x, double y, double z) { return Selection(Eigen::Vector3d(x, y, z)); }
Selection x_and_y() { return Selection(Eigen::Matrix<double, 3, 2>::Identity()); }

// Table I. The last column is what each type fixes in K (errata section 6).
const std::array<PatchTypeRow, 10>& table() {
  using enum SurfaceType;
  using enum BoundaryType;
  // surface, boundary, sizes of d, kappa and rotation, B
  static const std::array<PatchTypeRow, 10> rows = {{
      {elliptic_paraboloid, ellipse, 2, 2, 3, x_and_y()},
      {hyperbolic_paraboloid, ellipse, 2, 2, 3, x_and_y()},
      {cylindric_paraboloid, rectangle, 2, 1, 3, one(0, 1, 0)},
      {circular_paraboloid, circle, 1, 1, 2, one(1, 1, 0)},
      {plane, ellipse, 2, 0, 3, none()},
      {plane, circle, 1, 0, 2, none()},
      {plane, rectangle, 2, 0, 3, none()},
      {plane, convex_quad, 5, 0, 3, none()},
      {sphere, circle, 1, 1, 2, one(1, 1, 1)},
      {circular_cylinder, rectangle, 2, 1, 3, one(0, 1, 1)},
  }};
  return rows;
}

constexpr std::array<std::string_view, 7> surface_names = {"elliptic_paraboloid",
                                                           "hyperbolic_paraboloid",
                                                           "cylindric_paraboloid",
                                                           "circular_paraboloid",
                                                           "plane",
                                                           "sphere",
                                                           "circular_cylinder"};
constexpr std::array<std::string_view, 4> boundary_names = {"ellipse", "circle", "rectangle", "convex_quad"};

template <class Enum, std::size_t n>
std::optional<Enum> from_name(const std::array<std::string_view, n>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enum>(found - names.begin());
}

std::vector<std::string> names_of(const PatchTypeRow& type, const std::vector<std::string>& rotation,
                                  const std::string& position) {
  std::vector<std::string> names;
  if (type.boundary_size == 1) names = {"d"};
  if (type.boundary_size == 2) names = {"d_x", "d_y"};
  if (type.boundary_size == 5) names = {"d_1", "d_2", "d_3", "d_4", "gamma"};
  if (type.curvature_size == 1) names.push_back("kappa");
  if (type.curvature_size == 2) names.insert(names.end(), {"kappa_x", "kappa_y"});
  names.insert(names.end(), rotation.begin(), rotation.end());
  for (const char* axis : {"_x", "_y", "_z"}) names.push_back(position + axis);
  return names;
}

}  // namespace

std::span<const PatchTypeRow> patch_types() { return table(); }

const PatchTypeRow* find_patch_type(SurfaceType surface, BoundaryType boundary) {
  for (const PatchTypeRow& row : table()) {
    if (row.surface == surface && row.boundary == boundary) return &row;
  }
  return nullptr;
}

BoundaryType default_boundary(SurfaceType surface) {
  for (const PatchTypeRow& row : table()) {
    if (row.surface == surface) return row.boundary;
  }
  return BoundaryType::ellipse;
}

std::string_view name(SurfaceType surface) { return surface_names[static_cast<std::size_t>(surface)]; }
std::string_view name(BoundaryType boundary) { return boundary_names[static_cast<std::size_t>(boundary)]; }

std::optional<SurfaceType> surface_from_name(std::string_view name) {
  return from_name<SurfaceType>(surface_names, name);
}
std::optional<BoundaryType> boundary_from_name(std::string_view name) {
  return from_name<BoundaryType>(boundary_names, name);
}

std::vector<std::string> parameter_names(const PatchTypeRow& type) {
  return names_of(type,
                  type.revolute() ? std::vector<std::string>{"r_x", "r_y"}
                                  : std::vector<std::string>{"r_x", "r_y", "r_z"},
                  "c");
}

std::vector<std::string> local_names(const PatchTypeRow& type) {
  return names_of(type,
                  type.revolute() ? std::vector<std::string>{"tilt_x", "tilt_y"}
                                  : std::vector<std::string>{"w_x", "w_y", "w_z"},
                  "t");
}

}  // namespace patchlab
