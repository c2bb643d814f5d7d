// First and second moments of the foot points, and their covariance joined with that of the surface.
//
// The nine moments, in this order: mean x y z, then the second moments xx xy xz yy yz zz about the local
// origin (m, m^2), in the frame of the surface fit.
#pragma once

#include <Eigen/Core>

#include "engine/fit/fit_surface.h"

namespace patchlab {

inline constexpr int moments_size = 9;
using MomentVector = Eigen::Matrix<double, moments_size, 1>;

// Sum of weight_i phi(x_i), phi = (x, y, z, xx, xy, xz, yy, yz, zz).
MomentVector moments(const std::vector<Vector3d>& points, const std::vector<double>& weights);
MomentVector monomials(const Vector3d& x);
Eigen::Matrix<double, moments_size, 3> J_monomials(const Vector3d& x);

// Everything a boundary is made from: the surface's chart (8, at zero) and the moments (9), with their joint
// covariance.
inline constexpr int joint_size = chart_size + moments_size;
using JointMatrix = Eigen::Matrix<double, joint_size, joint_size>;

enum class Projection {
  foot_points,  // along the covariance to the surface (fitting.md section 4, item 9)
  plain,        // Eq. (16): the measured points, as the paper has it
};

struct JointOptions {
  Distance distance = Distance::exact;
  Projection projection = Projection::foot_points;
  bool sampling = true;  // which points happened to be sampled (fitting.md section 1.4)
};

// The covariance of (chart, moments), as D D' over whitened inputs (fitting.md sections 1.2-1.4). With q_i +=
// L_i e_i:
//   d chart / d e_i   = -A^-1 F_p (F_q' L_i)
//   d moments / d e_i = w_i Phi_x X_e,i + M d chart / d e_i,   M = sum_i w_i Phi_x X_chart,i
// as running sums: no p x 3N matrix is ever held. Prior and sampling add their own columns.
//
// `feet` are the points the moments are made of: foot points, or with Projection::plain the local samples
// themselves.
JointMatrix joint_covariance(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet,
                             const JointOptions& options);

}  // namespace patchlab
