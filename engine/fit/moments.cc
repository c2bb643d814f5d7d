#include "engine/fit/moments.h"

#include <array>
#include <cmath>

#include "engine/fit/sample_rows.h"

namespace patchlab {
namespace {

using Matrix93 = Eigen::Matrix<double, moments_size, 3>;
using Matrix98 = Eigen::Matrix<double, moments_size, chart_size>;
using Matrix32 = Eigen::Matrix<double, 3, 2>;
using Matrix38 = Eigen::Matrix<double, 3, chart_size>;

// What one sample contributes: how its projected point x moves with its noise and with the surface.
struct Motion {
  Matrix3d X_q;      // d x / d q, local axes
  Matrix38 X_chart;  // d x / d chart
};

Motion motion(const Residual& r, const SurfaceFit& fit, const Vector3d& q, const Matrix3d& S,
              Projection projection) {
  Motion m;
  if (projection == Projection::plain) {
    m.X_q.setIdentity();
    m.X_chart.leftCols<2>().setZero();
  } else {
    const Vector3d along = S * r.g / r.v;
    m.X_q = Matrix3d::Identity() - along * r.g.transpose();
    m.X_chart.leftCols<2>() = -along * J_f_chart(fit.model, r.x, r.g).head<2>().transpose();
  }
  m.X_chart.middleCols<3>(2) = m.X_q * skew(q);  // dq = [q]x w - t
  m.X_chart.rightCols<3>() = -m.X_q;
  return m;
}

using PlaneVector = Eigen::Matrix<double, plane_size, 1>;

// The chart rows that a plane frees: w_x, w_y, t_z.
constexpr std::array<int, plane_size> plane_rows = {2, 3, 7};

// How one sample moves a fit: a b', b in the axes of the surface.
template <class Vector>
struct Influence {
  Vector a;
  Vector3d b;
};

Influence<PlaneVector> influence_on_plane(const SurfaceFit& plane, const Samples& samples, std::size_t i,
                                          const Matrix3d& R) {
  const Residual r = residual(Distance::paper, plane.model, plane.state, samples.q[i], samples.cov[i]);
  PlaneVector F_p;
  for (int row = 0; row < plane_size; ++row) F_p[row] = r.F_p[plane_rows[static_cast<std::size_t>(row)]];
  return {F_p, R.transpose() * (plane.state.R * r.F_q)};
}

// B S B' summed over the samples, below the diagonal: what the fits and the moments take from the noise.
struct JointSums {
  JointMatrix G = JointMatrix::Zero();
  Matrix98 M = Matrix98::Zero();  // how the moments move with the surface

  void operator+=(const JointSums& other) {
    G += other.G;
    M += other.M;
  }

  void add_moments(const Matrix93& B, const Matrix93& BS) {
    G.bottomRightCorner<moments_size, moments_size>() += BS.lazyProduct(B.transpose());
  }
  template <int at, class Vector>
  void add_fit(const Influence<Vector>& fit, const Matrix93& BS, const Vector3d& Sb) {
    constexpr int size = Vector::RowsAtCompileTime;
    G.block<size, size>(at, at).noalias() += (fit.b.dot(Sb) * fit.a) * fit.a.transpose();
    G.block<moments_size, size>(moments_at, at).noalias() += MomentVector(BS * fit.b) * fit.a.transpose();
  }
  void add_both(const Influence<ChartVector>& fit, const Influence<PlaneVector>& plane, const Vector3d& Sb) {
    G.block<plane_size, chart_size>(plane_at, 0).noalias() += (plane.b.dot(Sb) * plane.a) * fit.a.transpose();
  }
  // Of a foot point X_q S g = 0, so that what moves the fit does not move it, and
  // X_q S X_q' = S - S g g' S / v.
  void add_foot_point(const Residual& r, const Matrix3d& S, const Matrix93& phi_x, const MomentVector& away,
                      const ChartVector& a) {
    const Vector3d Sg = S * r.g;
    Eigen::Matrix<double, moments_size, 4> left, right;
    left << phi_x.lazyProduct(Matrix3d(S - Sg * Sg.transpose() / r.v)), away;
    right << phi_x, away;
    G.bottomRightCorner<moments_size, moments_size>() += left.lazyProduct(right.transpose());
    G.topLeftCorner<chart_size, chart_size>() += a.lazyProduct(a.transpose());
  }
  JointMatrix whole() const { return G.selfadjointView<Eigen::Lower>(); }
};

// J_prior' J_prior (method M9): two columns of unit variance.
ChartMatrix prior_information(const SurfaceFit& fit) {
  ChartMatrix information = ChartMatrix::Zero();
  const Matrix32 tangents = fit.state.R.transpose() * fit.prior->tangents / fit.prior->sigma;
  information.bottomRightCorner<3, 3>() = tangents * tangents.transpose();
  return information;
}

// T of D = T B: the fits' own solves, and the moments carried along with the surface.
JointMatrix solve_all(const SurfaceFit& fit, const SurfaceFit* plane, const Matrix98& M) {
  JointMatrix T = JointMatrix::Zero();
  const ChartMatrix A_inverse = chart_covariance(fit);
  T.topLeftCorner<chart_size, chart_size>() = -A_inverse;
  T.bottomLeftCorner<moments_size, chart_size>() = -M * A_inverse;
  T.bottomRightCorner<moments_size, moments_size>().setIdentity();
  if (plane == nullptr) return T;
  const ChartMatrix plane_inverse = chart_covariance(*plane);
  for (int i = 0; i < plane_size; ++i) {
    for (int j = 0; j < plane_size; ++j) {
      T(plane_at + i, plane_at + j) =
          -plane_inverse(plane_rows[static_cast<std::size_t>(i)], plane_rows[static_cast<std::size_t>(j)]);
    }
  }
  return T;
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
  const MomentVector mean = moments(feet.x, feet.weight);
  const SampleRows rows(samples, fit.model, fit.state, options.distance);
  const bool of_foot_points = options.distance == Distance::exact &&
                              options.projection == Projection::foot_points && options.plane == nullptr;
  const auto add = [&](std::size_t i, const Residual& r, JointSums& sums) {
    if (samples.robust[i] == 0.0) return;
    const Vector3d q = to_local(fit.state, samples.q[i]);
    const Matrix3d S = fit.state.R.transpose() * samples.cov[i] * fit.state.R;
    const Motion m = motion(r, fit, q, S, options.projection);
    const Matrix93 phi_x = feet.weight[i] * J_monomials(feet.x[i]);
    sums.M += phi_x.lazyProduct(m.X_chart);
    const Influence<ChartVector> on_fit{std::sqrt(samples.robust[i]) * samples.bends[i] * r.F_p, r.F_q};
    const MomentVector away = options.sampling ? MomentVector(feet.weight[i] * (monomials(feet.x[i]) - mean))
                                               : MomentVector::Zero();
    if (of_foot_points) return sums.add_foot_point(r, S, phi_x, away, on_fit.a);
    const Matrix93 B = phi_x * m.X_q, BS = B * S;
    sums.add_moments(B, BS);
    const Vector3d Sb = S * on_fit.b;
    sums.add_fit<0>(on_fit, BS, Sb);
    if (options.plane != nullptr) {
      const auto on_plane = influence_on_plane(*options.plane, samples, i, fit.state.R);
      sums.add_fit<plane_at>(on_plane, BS, S * on_plane.b);
      sums.add_both(on_fit, on_plane, Sb);
    }
    sums.G.bottomRightCorner<moments_size, moments_size>().noalias() += away * away.transpose();
  };
  const JointSums sums = sum_of_residuals<JointSums>(rows, add);
  JointMatrix G = sums.whole();
  if (fit.prior) G.topLeftCorner<chart_size, chart_size>() += prior_information(fit);
  const JointMatrix T = solve_all(fit, options.plane, sums.M);
  const JointMatrix joint = T * G * T.transpose();
  return 0.5 * (joint + joint.transpose());
}

}  // namespace patchlab
