#include "engine/pose/chain.h"

namespace patchlab {
namespace {

Matrix3d rotation(const ChainElement& element) { return exp_map(element.phi * element.pose.pose.r); }  // R_j

// X_j of Eq. (10).
Vector3d apply(const ChainElement& element, const Matrix3d& R, const Vector3d& q) {
  const Vector3d& t = element.pose.pose.t;
  return element.phi > 0 ? Vector3d(R * q + t) : Vector3d(R * (q - t));
}

// Of every element: t_r of Eq. (46), where the elements towards the end put the end's origin.
std::vector<Vector3d> end_positions(const Chain& chain, const std::vector<Matrix3d>& R) {
  std::vector<Vector3d> t_r(chain.size() + 1, Vector3d::Zero());
  for (std::size_t j = chain.size(); j-- > 0;) t_r[j] = apply(chain[j], R[j], t_r[j + 1]);
  return t_r;
}

std::vector<Matrix3d> rotations(const Chain& chain) {
  std::vector<Matrix3d> R;
  for (const ChainElement& element : chain) R.push_back(rotation(element));
  return R;
}

// Block j of Eq. (46) in the form of errata section 7.
Matrix6d J_block(const ChainElement& element, const Matrix3d& R_l, const Matrix3d& R_j, const Vector3d& t_r,
                 const Matrix3d& Jl_inverse_c) {
  const Pose& pose = element.pose.pose;
  const bool forward = element.phi > 0;
  const Matrix3d W = element.phi * (R_l * left_jacobian(element.phi * pose.r));
  const Vector3d a = forward ? t_r : Vector3d(t_r - pose.t);
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = Jl_inverse_c * W;
  J.bottomLeftCorner<3, 3>() = -skew(R_l * (R_j * a)) * W;
  J.bottomRightCorner<3, 3>() = forward ? R_l : Matrix3d(-R_l * R_j);
  return J;
}

}  // namespace

Pose chain_pose(const Chain& chain) {
  Matrix3d R = Matrix3d::Identity();
  Vector3d t = Vector3d::Zero();
  for (std::size_t j = chain.size(); j-- > 0;) {
    const Matrix3d R_j = rotation(chain[j]);
    R = R_j * R;
    t = apply(chain[j], R_j, t);
  }
  return {log_map(R), t};  // Eq. (10)
}

Eigen::Matrix<double, 6, Eigen::Dynamic> J_chain(const Chain& chain) {
  const std::vector<Matrix3d> R = rotations(chain);
  const std::vector<Vector3d> t_r = end_positions(chain, R);
  const Matrix3d Jl_inverse_c = left_jacobian_inverse(chain_pose(chain).r);
  Eigen::Matrix<double, 6, Eigen::Dynamic> J(6, 6 * static_cast<Eigen::Index>(chain.size()));
  Matrix3d R_l = Matrix3d::Identity();
  for (std::size_t j = 0; j < chain.size(); ++j) {
    J.middleCols<6>(6 * static_cast<Eigen::Index>(j)) =
        J_block(chain[j], R_l, R[j], t_r[j + 1], Jl_inverse_c);
    R_l = R_l * R[j];
  }
  return J;
}

UncertainPose compose(const Chain& chain) {
  const Eigen::Matrix<double, 6, Eigen::Dynamic> J = J_chain(chain);
  Matrix6d cov = Matrix6d::Zero();
  for (std::size_t j = 0; j < chain.size(); ++j) {  // Eq. (42): the elements are independent
    const Matrix6d J_j = J.middleCols<6>(6 * static_cast<Eigen::Index>(j));
    cov += J_j * chain[j].pose.covariance * J_j.transpose();
  }
  return {chain_pose(chain), 0.5 * (cov + cov.transpose())};
}

UncertainAxisPose axis_pose(const UncertainPose& pose) {
  UncertainAxisPose out;
  out.r_xy = r_xy(pose.pose.r);
  out.t = pose.pose.t;
  const Matrix56d J5 = J_axis_pose(pose.pose);
  const Matrix5d cov = J5 * pose.covariance * J5.transpose();  // Eq. (43)
  out.covariance = 0.5 * (cov + cov.transpose());
  const Matrix23d J_tilt_r = (exp_map(lift(out.r_xy)).transpose() * left_jacobian(pose.pose.r)).topRows<2>();
  const Matrix2d cov_tilt = J_tilt_r * pose.covariance.topLeftCorner<3, 3>() * J_tilt_r.transpose();
  out.cov_tilt = 0.5 * (cov_tilt + cov_tilt.transpose());
  out.near_singular = near_singular(out.r_xy, out.cov_tilt);
  return out;
}

}  // namespace patchlab
