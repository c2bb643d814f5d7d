// First and second moments of the foot points, and their covariance joined with that of the surface.
//
// The nine moments, in this order: mean x y z, then the second moments xx xy xz yy yz zz about the local
// origin (m, m^2), in the frame of the surface fit.
#pragma once

#include <Eigen/Core>

#include "engine/fit/fit_surface.h"
#include "engine/fit/foot_points.h"
#include "engine/patch/patch.h"

namespace patchlab {

inline constexpr int moments_size = 9;
using MomentVector = Eigen::Matrix<double, moments_size, 1>;
using MomentMatrix = Eigen::Matrix<double, moments_size, moments_size>;
using MomentChartMatrix = Eigen::Matrix<double, moments_size, chart_size>;

// Sum of weight_i phi(x_i), phi = (x, y, z, xx, xy, xz, yy, yz, zz).
MomentVector moments(const std::vector<Vector3d>& points, const std::vector<double>& weights);
MomentVector monomials(const Vector3d& x);
Eigen::Matrix<double, moments_size, 3> J_monomials(const Vector3d& x);

// Everything a bounded patch is made from, in this order: the surface's chart (8, at zero); the tilt and
// height of the plane of step 1 (w_x w_y t_z in its own axes), from which the paper's method takes the
// normal; the moments (9).
inline constexpr int plane_at = chart_size, plane_size = 3;
inline constexpr int moments_at = plane_at + plane_size;
inline constexpr int joint_size = moments_at + moments_size;
using JointMatrix = Eigen::Matrix<double, joint_size, joint_size>;
using JointRows = Eigen::Matrix<double, Eigen::Dynamic, joint_size, 0, 11, joint_size>;

enum class Projection {
  foot_points,  // along the covariance to the surface (errata F9)
  plain,        // Eq. (16): the measured points, as the paper has it
};

struct JointOptions {
  Distance distance = Distance::exact;
  Projection projection = Projection::foot_points;
  bool sampling = true;               // which points happened to be sampled (method M9)
  const SurfaceFit* plane = nullptr;  // of step 1, where its normal counts
};

// The covariance of all these, as D D' over whitened inputs (method M8, M9). With q_i += e_i:
//   d chart / d e_i   = -A^-1 F_p F_q'
//   d plane / d e_i   = the same of the plane's fit
//   d moments / d e_i = w_i Phi_x X_q,i + M d chart / d e_i,   M = sum_i w_i Phi_x X_chart,i
// D = T B with B_i = (F_p F_q'; F_p F_q' of the plane; w_i Phi_x X_q), so that B Sigma B' is a running sum:
// no p x 3N matrix is ever held. Prior and sampling add their own columns.
struct JointSums {
  JointMatrix G = JointMatrix::Zero();              // B Sigma B', with sampling, below the diagonal
  MomentChartMatrix M = MomentChartMatrix::Zero();  // how the moments move with the surface

  void operator+=(const JointSums& other) {
    G += other.G;
    M += other.M;
  }
};

// One sample at a time. `feet` are the points the moments are made of: foot points, or with
// Projection::plain the local samples themselves.
JointSums joint_sums(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet,
                     const JointOptions& options);

// T G T' of these sums, prior included.
class JointCovariance {
 public:
  JointCovariance() = default;
  JointCovariance(const JointSums& sums, const SurfaceFit& fit, const SurfaceFit* plane);
  // Of what has these derivatives by everything: J T G T' J'.
  PatchMatrix of(const JointRows& J) const;

 private:
  JointMatrix G_ = JointMatrix::Zero();
  ChartMatrix A_inverse_ = ChartMatrix::Zero();
  MomentChartMatrix M_ = MomentChartMatrix::Zero();
  Matrix3d plane_inverse_ = Matrix3d::Zero();
  bool moments_share_fit_ = false, by_plane_ = false;  // whether these parts of G are not 0
};

}  // namespace patchlab
