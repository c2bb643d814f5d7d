#include "tests/bench/fit/height_field.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace patchlab::bench {

HeightField height_field_fit(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& q : points) mean += q;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& q : points) scatter += (q - mean) * (q - mean).transpose();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors();
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  HeightField b = HeightField::Zero();
  for (const Eigen::Vector3d& q : points) {
    const Eigen::Vector3d u = axes.transpose() * (q - mean);
    const HeightField row{1.0, u[1], u[2], 0.5 * u[1] * u[1], u[1] * u[2], 0.5 * u[2] * u[2]};
    A.selfadjointView<Eigen::Lower>().rankUpdate(row);
    b += u[0] * row;
  }
  return A.selfadjointView<Eigen::Lower>().ldlt().solve(b);
}

}  // namespace patchlab::bench
