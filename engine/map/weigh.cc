#include "engine/map/weigh.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace patchlab {
namespace {

using Eigen::MatrixXd;

constexpr double alike = 2.0;  // variances within this factor of each other

}  // namespace

MatrixXd levelled(const Measurement& m, int sights) {
  const MatrixXd known = m.H * m.P * m.H.transpose();
  if (Eigen::LLT<MatrixXd>(known).info() != Eigen::Success) return m.R;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(m.R, known);
  if (solver.info() != Eigen::Success) return m.R;
  Eigen::VectorXd ratio = solver.eigenvalues();
  ratio = ratio.cwiseMax(0.0);
  for (double& r : ratio) r += std::clamp(sights - r, -(1.0 - 1.0 / alike) * r, (alike - 1.0) * r);
  const MatrixXd V = known * solver.eigenvectors();
  return V * ratio.asDiagonal() * V.transpose();
}

}  // namespace patchlab
