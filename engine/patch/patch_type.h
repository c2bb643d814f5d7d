// Table I: the ten patch types, one row each. Whatever depends on the type is read from its row.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/patch/boundary.h"

namespace patchlab {

enum class SurfaceType {
  elliptic_paraboloid,
  hyperbolic_paraboloid,
  cylindric_paraboloid,
  circular_paraboloid,
  plane,
  sphere,
  circular_cylinder,
};

struct PatchTypeRow {
  SurfaceType surface;
  BoundaryType boundary;
  int boundary_size;                                    // number of d parameters
  int curvature_size;                                   // number of kappas: columns of B
  int rotation_size;                                    // 3: r, or 2: r_xy (revolute symmetry)
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2> B;  // k3 = B k (errata D10)

  int size() const { return boundary_size + curvature_size + rotation_size + 3; }  // DoF column of Table I
  int curvature_at() const { return boundary_size; }                               // index of the first kappa
  int rotation_at() const { return boundary_size + curvature_size; }
  int position_at() const { return rotation_at() + rotation_size; }
  bool revolute() const { return rotation_size == 2; }
};

// The ten rows, in the order of Table I.
std::span<const PatchTypeRow> patch_types();
// The row of a pair, or nothing: Table I pairs each curved surface with one boundary.
const PatchTypeRow* find_patch_type(SurfaceType surface, BoundaryType boundary);
// The boundary that Table I gives a curved surface; the ellipse for a plane.
BoundaryType default_boundary(SurfaceType surface);

std::string_view name(SurfaceType surface);    // "elliptic_paraboloid" ...
std::string_view name(BoundaryType boundary);  // "ellipse" ...
std::optional<SurfaceType> surface_from_name(std::string_view name);
std::optional<BoundaryType> boundary_from_name(std::string_view name);

// Names of the parameters in order: d_x d_y | d | d_1 d_2 d_3 d_4 gamma; kappa_x kappa_y | kappa; r_x r_y r_z
// | r_x r_y; c_x c_y c_z.
std::vector<std::string> parameter_names(const PatchTypeRow& type);
// Names in the local chart: the same d and kappa, then w_x w_y w_z or tilt_x tilt_y, then t_x t_y t_z.
std::vector<std::string> local_names(const PatchTypeRow& type);

}  // namespace patchlab
