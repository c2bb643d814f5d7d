#include "engine/fit/moments.h"

#include <cmath>

#include "engine/fit/sample_rows.h"

namespace patchlab {
namespace {

using Matrix93 = Eigen::Matrix<double, moments_size, 3>;
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
constexpr int plane_rows[plane_size] = {2, 3, 7};

// How one sample moves a fit: a b', b in the axes of the surface.
template <class Vector>
struct Influence {
  Vector a;
  Vector3d b;
};

Influence<PlaneVector> influence_on_plane(const SurfaceFit& plane, const Samples& samples, std::size_t i,
                                          const Matrix3d& R) {
  const Residual r = residual(Distance::paper, plane.model, plane.state, samples.q(i), samples.cov(i));
  PlaneVector F_p;
  for (int row = 0; row < plane_size; ++row) F_p[row] = r.F_p[plane_rows[row]];
  return {F_p, R.transpose() * (plane.state.R * r.F_q)};
}

// What the samples add to the sums, below the diagonal.
void add_moments(const Matrix93& B, const Matrix93& BS, const MomentVector& away, JointSums& sums) {
  sums.G.bottomRightCorner<moments_size, moments_size>() +=
      BS.lazyProduct(B.transpose()) + away.lazyProduct(away.transpose());
}
template <int at, class Vector>
void add_fit(const Influence<Vector>& fit, const Matrix93& BS, const Vector3d& Sb, JointSums& sums) {
  constexpr int size = Vector::RowsAtCompileTime;
  sums.G.block<size, size>(at, at).noalias() += (fit.b.dot(Sb) * fit.a) * fit.a.transpose();
  sums.G.block<moments_size, size>(moments_at, at).noalias() += MomentVector(BS * fit.b) * fit.a.transpose();
}
void add_both(const Influence<ChartVector>& fit, const Influence<PlaneVector>& plane, const Vector3d& Sb,
              JointSums& sums) {
  sums.G.block<plane_size, chart_size>(plane_at, 0).noalias() +=
      (plane.b.dot(Sb) * plane.a) * fit.a.transpose();
}

// J_prior' J_prior (method M9): two columns of unit variance.
ChartMatrix prior_information(const SurfaceFit& fit) {
  ChartMatrix information = ChartMatrix::Zero();
  const Matrix32 tangents = fit.state.R.transpose() * fit.prior->tangents / fit.prior->sigma;
  information.bottomRightCorner<3, 3>() = tangents * tangents.transpose();
  return information;
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

JointSums joint_sums(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet,
                     const JointOptions& options) {
  const MomentVector mean = moments(feet.x, feet.weight);
  const SampleRows rows(samples, fit.model, fit.state, options.distance);
  const auto add = [&](std::size_t i, const Residual& r, JointSums& sums) {
    if (samples.robust[i] == 0.0) return;
    const Vector3d q = to_local(fit.state, samples.q(i));
    const Matrix3d S = fit.state.R.transpose() * samples.cov(i) * fit.state.R;
    const Motion m = motion(r, fit, q, S, options.projection);
    const Matrix93 phi_x = feet.weight[i] * J_monomials(feet.x[i]);
    sums.M += phi_x.lazyProduct(m.X_chart);
    const Influence<ChartVector> on_fit{std::sqrt(samples.robust[i]) * samples.bends[i] * r.F_p, r.F_q};
    const MomentVector away = options.sampling ? MomentVector(feet.weight[i] * (monomials(feet.x[i]) - mean))
                                               : MomentVector::Zero();
    const Matrix93 B = phi_x * m.X_q, BS = B * S;
    const Vector3d Sb = S * on_fit.b;
    add_moments(B, BS, away, sums);
    add_fit<0>(on_fit, BS, Sb, sums);
    if (options.plane == nullptr) return;
    const auto on_plane = influence_on_plane(*options.plane, samples, i, fit.state.R);
    add_fit<plane_at>(on_plane, BS, S * on_plane.b, sums);
    add_both(on_fit, on_plane, Sb, sums);
  };
  return sum_of_residuals<JointSums>(rows, add);
}

JointCovariance::JointCovariance(const JointSums& sums, const SurfaceFit& fit, const SurfaceFit* plane)
    : G_(sums.G.selfadjointView<Eigen::Lower>()),
      A_inverse_(chart_covariance(fit)),
      M_(sums.M),
      moments_share_fit_(!sums.G.bottomLeftCorner<moments_size, chart_size>().isZero(0.0)),
      by_plane_(plane != nullptr) {
  if (fit.prior) G_.topLeftCorner<chart_size, chart_size>() += prior_information(fit);
  if (plane == nullptr) return;
  const ChartMatrix of_plane = chart_covariance(*plane);
  for (int i = 0; i < plane_size; ++i) {
    for (int j = 0; j < plane_size; ++j) plane_inverse_(i, j) = of_plane(plane_rows[i], plane_rows[j]);
  }
}

// Rows of 0 to an even number of them, which vector instructions take two at a time.
PatchMatrix JointCovariance::of(const JointRows& J) const {
  constexpr int most = 12;
  using ChartRows = Eigen::Matrix<double, most, chart_size>;
  using PlaneRows = Eigen::Matrix<double, most, plane_size>;
  using MomentRowsOf = Eigen::Matrix<double, most, moments_size>;
  using Square = Eigen::Matrix<double, most, most>;
  const auto n = J.rows();
  ChartRows by_chart = ChartRows::Zero();
  PlaneRows by_plane = PlaneRows::Zero();
  MomentRowsOf by_moments = MomentRowsOf::Zero();
  by_chart.topRows(n) = J.leftCols<chart_size>();
  by_plane.topRows(n) = J.middleCols<plane_size>(plane_at);
  by_moments.topRows(n) = J.rightCols<moments_size>();
  by_chart += by_moments.lazyProduct(M_);
  const ChartRows chart = -by_chart.lazyProduct(A_inverse_);
  const ChartRows chart_G = chart.lazyProduct(G_.topLeftCorner<chart_size, chart_size>());
  const MomentRowsOf moments_G = by_moments.lazyProduct(G_.bottomRightCorner<moments_size, moments_size>());
  Square cov = chart_G.lazyProduct(chart.transpose());
  cov += moments_G.lazyProduct(by_moments.transpose());
  Square shared = Square::Zero();  // its transpose belongs to it
  if (moments_share_fit_) {
    const ChartRows with_fit = by_moments.lazyProduct(G_.bottomLeftCorner<moments_size, chart_size>());
    shared += with_fit.lazyProduct(chart.transpose());
  }
  if (by_plane_) {
    const PlaneRows plane = -by_plane.lazyProduct(plane_inverse_);
    const auto G_plane = G_.middleRows<plane_size>(plane_at);
    const PlaneRows plane_G = plane.lazyProduct(G_plane.middleCols<plane_size>(plane_at));
    cov += plane_G.lazyProduct(plane.transpose());
    const ChartRows with_fit = plane.lazyProduct(G_plane.leftCols<chart_size>());
    const MomentRowsOf with_moments = plane.lazyProduct(G_plane.rightCols<moments_size>());
    shared += with_fit.lazyProduct(chart.transpose());
    shared += with_moments.lazyProduct(by_moments.transpose());
  }
  cov += shared + shared.transpose();
  return 0.5 * (cov + cov.transpose()).topLeftCorner(n, n);
}

}  // namespace patchlab
