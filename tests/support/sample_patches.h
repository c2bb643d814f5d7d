// One patch of every row of Table I, of both signs where it is curved, and the hard ones: the rim |kappa| d =
// 1, quads without a vertex or a side. In general position, canonical orientation.
#pragma once

#include <string>
#include <vector>

#include "engine/patch/patch.h"

namespace patchlab::test {

struct SamplePatch {
  std::string label;
  Patch patch;
};

inline SamplePatch sample_patch(const std::string& label, SurfaceType surface, BoundaryType boundary_type,
                                const std::vector<double>& d, const std::vector<double>& kappa) {
  const PatchTypeRow& type = *find_patch_type(surface, boundary_type);
  const Boundary boundary{boundary_type, Eigen::Map<const Eigen::VectorXd>(d.data(), type.boundary_size)};
  const Eigen::VectorXd curvatures = Eigen::Map<const Eigen::VectorXd>(kappa.data(), type.curvature_size);
  const Matrix3d R = exp_map(Vector3d(0.7, -1.1, 0.4));
  return {label, make_patch(type, boundary, curvatures, R, Vector3d(0.3, -0.2, 1.1))};
}

inline std::vector<SamplePatch> sample_patches() {
  using enum SurfaceType;
  using enum BoundaryType;
  std::vector<SamplePatch> samples;
  for (const double sign : {1.0, -1.0}) {
    const std::string way = sign > 0.0 ? "_concave" : "_convex";
    const auto add = [&](const char* label, SurfaceType surface, BoundaryType boundary,
                         const std::vector<double>& d, std::vector<double> kappa) {
      for (double& k : kappa) k *= sign;
      samples.push_back(sample_patch(label + way, surface, boundary, d, kappa));
    };
    add("elliptic_paraboloid", elliptic_paraboloid, ellipse, {0.12, 0.07}, {3.0, 9.0});
    add("hyperbolic_paraboloid", hyperbolic_paraboloid, ellipse, {0.12, 0.07}, {-3.0, 9.0});
    add("cylindric_paraboloid", cylindric_paraboloid, rectangle, {0.15, 0.06}, {11.0});
    add("circular_paraboloid", circular_paraboloid, circle, {0.09}, {8.0});
    add("sphere", sphere, circle, {0.07}, {11.0});
    add("sphere_rim", sphere, circle, {0.08}, {12.5});
    add("circular_cylinder", circular_cylinder, rectangle, {0.15, 0.05}, {12.0});
    add("circular_cylinder_rim", circular_cylinder, rectangle, {0.15, 0.05}, {20.0});
  }
  const auto add_plane = [&](const char* label, BoundaryType boundary, const std::vector<double>& d) {
    samples.push_back(sample_patch(label, plane, boundary, d, {}));
  };
  add_plane("plane_ellipse", ellipse, {0.14, 0.05});
  add_plane("plane_circle", circle, {0.08});
  add_plane("plane_rectangle", rectangle, {0.11, 0.05});
  add_plane("plane_quad", convex_quad, {0.10, 0.14, 0.07, 0.12, 0.5});
  add_plane("plane_quad_straight_corner", convex_quad, {0.0, 0.14, 0.07, 0.12, 0.5});
  add_plane("plane_quad_almost_straight_corner", convex_quad, {0.10, 0.14, 1e-7, 0.12, 0.5});
  add_plane("plane_quad_without_first_side", convex_quad, {0.0, 0.0, 0.07, 0.12, 0.5});
  add_plane("plane_quad_without_second_side", convex_quad, {0.10, 0.0, 0.0, 0.12, 0.5});
  add_plane("plane_quad_without_last_side", convex_quad, {0.0, 0.14, 0.07, 0.0, 0.5});
  return samples;
}

}  // namespace patchlab::test
