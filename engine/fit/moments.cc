#include "engine/fit/moments.h"

#include <Eigen/Cholesky>

namespace patchlab {
namespace {

using Matrix9 = Eigen::Matrix<double, moments_size, moments_size>;
using Matrix93 = Eigen::Matrix<double, moments_size, 3>;
using Matrix98 = Eigen::Matrix<double, moments_size, chart_size>;
using Matrix38 = Eigen::Matrix<double, 3, chart_size>;

// What one sample contributes: how its projected point x moves with its noise and with the surface.
struct Motion {
  Matrix3d X_q;      // d x / d q, local axes
  Matrix38 X_chart;  // d x / d chart
};

Motion motion(const Residual& r, const SurfaceFit& fit, const Vector3d& q, const Matrix3d& S,
              Projection projection) {
  Matrix38 q_chart = Matrix38::Zero();  // dq = [q]x w - t
  q_chart.middleCols<3>(2) = skew(q);
  q_chart.rightCols<3>() = -Matrix3d::Identity();
  if (projection == Projection::plain) return {Matrix3d::Identity(), q_chart};
  const Vector3d along = S * r.g / r.v;
  Motion m;
  m.X_q = Matrix3d::Identity() - along * r.g.transpose();
  m.X_chart = m.X_q * q_chart;
  m.X_chart.leftCols<2>() -= along * J_f_chart(fit.model, r.x, r.g).head<2>().transpose();
  return m;
}

}  // namespace

MomentVector monomials(const Vector3d& x) {
  MomentVector phi;
  phi << x, x.x() * x.x(), x.x() * x.y(), x.x() * x.z(), x.y() * x.y(), x.y() * x.z(), x.z() * x.z();
  return phi;
}

Eigen::Matrix<double, moments_size, 3> J_monomials(const Vector3d& x) {
  Eigen::Matrix<double, moments_size, 3> J;
  J << Matrix3d::Identity(),  //
      2.0 * x.x(), 0.0, 0.0,  // xx
      x.y(), x.x(), 0.0,      // xy
      x.z(), 0.0, x.x(),      // xz
      0.0, 2.0 * x.y(), 0.0,  // yy
      0.0, x.z(), x.y(),      // yz
      0.0, 0.0, 2.0 * x.z();  // zz
  return J;
}

MomentVector moments(const std::vector<Vector3d>& points, const std::vector<double>& weights) {
  MomentVector sum = MomentVector::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * monomials(points[i]);
  return sum;
}

JointMatrix joint_covariance(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet,
                             const JointOptions& options) {
  const StepMatrix A_inverse = fit.A.ldlt().solve(StepMatrix::Identity(fit.A.rows(), fit.A.cols()));
  const ChartMatrix cov_chart = spread(fit.model, StepMatrix(0.5 * (A_inverse + A_inverse.transpose())));
  const MomentVector mean = moments(feet.x, feet.weight);
  Matrix98 M = Matrix98::Zero();  // d moments / d chart
  Matrix98 leak =
      Matrix98::Zero();           // sum of (d moments / d e)(F_q' L)' F_p': zero where foot points are exact
  Matrix9 own = Matrix9::Zero();  // of the moments alone: noise across the normal, and sampling
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double weight = feet.weight[i];
    if (weight == 0.0) continue;
    const Vector3d q = to_local(fit.state, samples.q[i]);
    const Matrix3d S = fit.state.R.transpose() * samples.cov[i] * fit.state.R;
    const Residual r = residual(options.distance, fit.model, fit.state, samples.q[i], samples.cov[i]);
    const Motion m = motion(r, fit, q, S, options.projection);
    const Matrix93 phi_x = weight * J_monomials(feet.x[i]);
    const Matrix93 phi_q = phi_x * m.X_q;
    M.noalias() += phi_x * m.X_chart;
    leak.noalias() += (phi_q * (S * r.F_q)) * r.F_p.transpose();
    own.noalias() += phi_q * S * phi_q.transpose();
    if (options.sampling) {
      const MomentVector away = weight * (monomials(feet.x[i]) - mean);
      own.noalias() += away * away.transpose();
    }
  }
  const Matrix98 direct = M * cov_chart, indirect = -leak * cov_chart;
  JointMatrix joint;
  joint.topLeftCorner<chart_size, chart_size>() = cov_chart;
  joint.bottomLeftCorner<moments_size, chart_size>() = direct + indirect;
  joint.topRightCorner<chart_size, moments_size>() = (direct + indirect).transpose();
  joint.bottomRightCorner<moments_size, moments_size>() =
      own + direct * M.transpose() + indirect * M.transpose() + M * indirect.transpose();
  return joint;
}

}  // namespace patchlab
