#include "engine/map/joint_update.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace patchlab {
namespace {

using Eigen::MatrixXd;

MatrixXd symmetric(const MatrixXd& A) { return 0.5 * (A + A.transpose()); }

struct Innovation {
  Eigen::VectorXd y;  // less what the mean of delta says
  Eigen::LDLT<MatrixXd> S;
};

Innovation innovation(const Measurement& m, const SharedError& delta) {
  return {m.y - m.G * delta.mean, Eigen::LDLT<MatrixXd>(symmetric(m.H * m.P * m.H.transpose() + m.R))};
}

MatrixXd gain(const Measurement& m, const PatchMatrix& P, const Eigen::LDLT<MatrixXd>& S) {
  return S.solve(m.H * P).transpose();
}

MatrixXd gain_taken(const Measurement& m, const Eigen::LDLT<MatrixXd>& S) {
  const PatchMatrix& P = m.P_gain.size() == 0 ? m.P : m.P_gain;
  if (m.R_gain.size() == 0) return gain(m, P, S);
  return gain(m, P, Eigen::LDLT<MatrixXd>(symmetric(m.H * m.P * m.H.transpose() + m.R_gain)));
}

Updated update_one(const Measurement& m, const SharedError& delta, const Eigen::LDLT<MatrixXd>& S) {
  const Eigen::VectorXd y = m.y - m.G * delta.mean;
  const MatrixXd K_best = gain(m, m.P, S), K = gain_taken(m, S);
  const MatrixXd L = MatrixXd::Identity(m.P.rows(), m.P.cols()) - K * m.H;
  // With another gain than the best, what is left of x errs together with delta.
  const MatrixXd off = (K_best - K) * m.G;
  Updated out;
  out.C = m.T - K_best * m.G;
  out.x = K * y + m.T * delta.mean;
  out.P = symmetric(L * m.P * L.transpose() + K * m.R * K.transpose() +  // Joseph's form
                    out.C * delta.covariance * out.C.transpose() - off * delta.covariance * off.transpose());
  out.chi2 = y.dot(S.solve(y));
  return out;
}

}  // namespace

JointUpdate update_jointly(const std::vector<Measurement>& measurements, const SharedError& prior) {
  JointUpdate out;
  std::vector<Innovation> innovations;
  Matrix6d information = Matrix6d::Zero();
  Vector6d pull = Vector6d::Zero();
  for (const Measurement& m : measurements) {
    innovations.push_back(innovation(m, prior));
    const auto& [y, S] = innovations.back();
    information += m.G.transpose() * S.solve(MatrixXd(m.G));
    pull += m.G.transpose() * S.solve(y);
    out.chi2 += y.dot(S.solve(y));
    out.dof += static_cast<int>(y.size());
  }
  const Matrix6d cov =
      (Matrix6d::Identity() + prior.covariance * information).partialPivLu().solve(prior.covariance);
  out.delta.covariance = 0.5 * (cov + cov.transpose());
  const Vector6d change = out.delta.covariance * pull;
  out.delta.mean = prior.mean + change;
  out.chi2 -= pull.dot(change);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    out.patches.push_back(update_one(measurements[i], out.delta, innovations[i].S));
  }
  return out;
}

PatchMatrix bounds_apart(const PatchTypeRow& type, const PatchMatrix& covariance_local) {
  PatchMatrix out = covariance_local;
  const int d = type.boundary_size, rest = type.size() - d;
  out.topRightCorner(d, rest).setZero();
  out.bottomLeftCorner(rest, d).setZero();
  return out;
}

}  // namespace patchlab
