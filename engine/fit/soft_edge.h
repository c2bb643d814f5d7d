// Quadrilaterals and rectangles by maximum likelihood with a soft edge (method M7): points
// cover the shape evenly and are smeared by sigma, so the likelihood of a shape of area A is
//   -N ln A + sum_i w_i sum_e ln Phi(distance_ie / sigma),  w_i of sum N.
//
// A shape is four lines n(phi_e)' u = rho_e with outward normals, counterclockwise.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/pose/axis_pose.h"

namespace patchlab {

// phi_1 rho_1 ... phi_4 rho_4: rad, m.
using EdgeVector = Eigen::Matrix<double, 8, 1>;
using EdgeMatrix = Eigen::Matrix<double, 8, 8>;

struct SoftShape {
  EdgeVector edges;
  double inset = 0.0;                          // m: how far inside the true edges these lie, by the softening
  EdgeMatrix covariance = EdgeMatrix::Zero();  // inverse of the information; rank 5 for a rectangle
  double log_likelihood = 0.0;
  bool converged = false;
};

enum class Corners { free, right };  // a convex quad, or a rectangle

// `weights` sum to 1; `used` is N; `lateral_variance` that of the points' noise in the plane, m^2.
SoftShape fit_soft_edges(const std::vector<Vector2d>& points, const std::vector<double>& weights, double used,
                         double lateral_variance, Corners corners);

EdgeVector moved_out(const EdgeVector& edges, double by);

// The convex quad (21) with these edges: d_1..d_4 gamma, the turn of its x axis from the frame's (w_z), its
// centre (t_x, t_y), and the derivatives of these eight for the edges.
struct EdgeQuad {
  Eigen::Matrix<double, 5, 1> d;
  double turn;
  Vector2d centre;
  EdgeMatrix J_quad_edges;  // rows d_1..d_4 gamma turn centre
};
EdgeQuad quad_of_edges(const EdgeVector& edges);

// Convex hull, counterclockwise; and the quad about it with little area, found by dropping the hull's edges
// one by one.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points);

}  // namespace patchlab
