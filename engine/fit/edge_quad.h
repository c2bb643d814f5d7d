// A quadrilateral as four lines n(phi_e)' u = rho_e with outward normals, counterclockwise.
#pragma once

#include <Eigen/Core>

#include "engine/pose/axis_pose.h"

namespace patchlab {

// phi_1 rho_1 ... phi_4 rho_4: rad, m.
using EdgeVector = Eigen::Matrix<double, 8, 1>;
using EdgeMatrix = Eigen::Matrix<double, 8, 8>;

// Every edge moved outwards by as much (m).
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

}  // namespace patchlab
