#include "tests/support/nees.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <vector>

namespace patchlab::test {
namespace {

constexpr double least_pivot = 1e-13;  // of a correlation matrix that is not singular in double precision

Nees nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& cov) {
  Nees result;
  result.dof = static_cast<int>(error.size());
  result.errors = error;
  result.sigmas = cov.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::VectorXd scale = result.sigmas.cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd correlation = scale.asDiagonal() * cov * scale.asDiagonal();
  const Eigen::VectorXd scaled = scale.cwiseProduct(error);
  const auto factors = correlation.ldlt();
  const bool regular = factors.vectorD().minCoeff() > least_pivot;  // false for NaN too
  result.value = regular ? scaled.dot(factors.solve(scaled)) : std::numeric_limits<double>::infinity();
  return result;
}

// Error of the truth from the fit in the fit's local chart; the pose part as a screw, R <- R R(w), c <- c + R
// Jl(w) t: the chart in which a vertex that slides along a curved surface errs by what the covariance says,
// not by its square.
PatchVector local_error(const Patch& fitted, const Patch& truth) {
  const PatchTypeRow& type = *fitted.type;
  PatchVector error = truth.parameters - fitted.parameters;
  const Matrix3d R = axes(fitted);
  Vector3d w = log_map(R.transpose() * axes(truth));
  if (type.revolute()) {
    const Vector3d z = R.transpose() * axes(truth).col(2);
    w = Vector3d(-z.y(), z.x(), 0.0);
  }
  error.segment(type.rotation_at(), type.rotation_size) = w.head(type.rotation_size);
  error.segment<3>(type.position_at()) =
      left_jacobian_inverse(w) * (R.transpose() * (centre(truth) - centre(fitted)));
  return error;
}

std::vector<Patch> descriptions(const Patch& truth) {
  if (truth.type->revolute()) return {truth};
  std::vector<Patch> all = {truth, half_turn(truth)};
  const bool cylindric = truth.type->curvature_size == 1;
  if (!cylindric) {
    all.push_back(swap_axes(truth));
    all.push_back(half_turn(all.back()));
  }
  return all;
}

PatchMatrix cov_local(const Patch& patch) { return *patch.covariance_local; }

// Rows of the local chart picked or combined: kappa, w or tilt, t at their places.
Nees picked(const Patch& fitted, const PatchVector& error, const std::vector<int>& rows) {
  Eigen::VectorXd e(static_cast<Eigen::Index>(rows.size()));
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(e.size(), fitted.parameters.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    e[static_cast<Eigen::Index>(i)] = error[rows[i]];
    J(static_cast<Eigen::Index>(i), rows[i]) = 1.0;
  }
  return nees(e, J * cov_local(fitted) * J.transpose());
}

// Where the line along the fit's z_l through its apex meets the true surface, and the outward normal there,
// in the axes of the fit: what the points determine, however weak the curvature is.
struct Crossing {
  double t_z;
  Vector3d normal;
};
Crossing crossing(const Patch& fitted, const Patch& truth) {
  const Matrix3d R = axes(fitted);
  const Vector3d origin = apply_inverse(world_from_patch(truth), centre(fitted));
  const Vector3d direction = axes(truth).transpose() * R.col(2);
  const Vector3d kappa = k3(truth);
  double least = std::numeric_limits<double>::infinity();
  for (const double side : {1.0, -1.0}) {
    const RayHits hits = ray_hits(origin, side * direction, kappa);
    for (int i = 0; i < hits.count; ++i) {
      if (hits.s[i] < std::abs(least)) least = side * hits.s[i];
    }
  }
  const Vector3d q = origin + least * direction;
  return {least, R.transpose() * (axes(truth) * outward_normal(q, kappa))};
}

Nees sphere_nees(const Patch& fitted, const Patch& truth) {
  const Crossing at = crossing(fitted, truth);
  const double kappa = fitted.parameters[1];
  Eigen::Vector4d error;
  error << truth.parameters[1] - kappa, at.normal.x(), at.normal.y(), at.t_z;
  Eigen::Matrix<double, 4, 7> J = Eigen::Matrix<double, 4, 7>::Zero();  // (d, kappa, tilt, t)
  J(0, 1) = 1.0;
  J.row(1) << 0.0, 0.0, 0.0, 1.0, kappa, 0.0, 0.0;  // n_x = tilt_y + kappa t_x
  J.row(2) << 0.0, 0.0, -1.0, 0.0, 0.0, kappa, 0.0;
  J(3, 6) = 1.0;
  return nees(error, J * cov_local(fitted) * J.transpose());
}

Nees cylinder_nees(const Patch& fitted, const Patch& truth) {
  const Crossing at = crossing(fitted, truth);
  const double kappa = fitted.parameters[2];
  Vector3d along = axes(fitted).transpose() * axes(truth).col(0);
  if (along.x() < 0.0) along = -along;
  Eigen::Matrix<double, 5, 1> error;
  error << truth.parameters[2] - kappa, along.y(), along.z(), at.normal.y(), at.t_z;
  Eigen::Matrix<double, 5, 9> J = Eigen::Matrix<double, 5, 9>::Zero();  // (d_x, d_y, kappa, w, t)
  J(0, 2) = 1.0;
  J(1, 5) = 1.0;
  J(2, 4) = -1.0;
  J(3, 3) = -1.0;
  J(3, 7) = kappa;
  J(4, 8) = 1.0;
  return nees(error, J * cov_local(fitted) * J.transpose());
}

Nees plane_nees(const Patch& fitted, const Patch& truth) {
  const PatchTypeRow& type = *fitted.type;
  const Vector3d n = axes(fitted).transpose() * axes(truth).col(2);
  PatchVector error = PatchVector::Zero(fitted.parameters.size());
  error[type.rotation_at()] = -n.y();
  error[type.rotation_at() + 1] = n.x();
  const Vector3d apart = axes(fitted).transpose() * (centre(truth) - centre(fitted));
  error[type.position_at() + 2] = n.dot(apart) / n.z();
  return picked(fitted, error, {type.rotation_at(), type.rotation_at() + 1, type.position_at() + 2});
}

// The vertex line of a cylindric paraboloid: the truth's vertex slid to where the fit's is.
Nees cylindric_nees(const Patch& fitted, const Patch& truth) {
  PatchVector error = local_error(fitted, truth);
  const Vector3d along = axes(fitted).transpose() * axes(truth).col(0);
  Vector3d t = error.segment<3>(6);
  t -= along * (t.x() / along.x());
  error.segment<3>(6) = t;
  return picked(fitted, error, {2, 3, 4, 5, 7, 8});
}

}  // namespace

Patch nearest_description(const Patch& fitted, const Patch& truth) {
  Patch best = truth;
  double least = std::numeric_limits<double>::infinity();
  for (const Patch& description : descriptions(truth)) {
    const double turn = log_map(axes(fitted).transpose() * axes(description)).norm();
    if (turn < least) {
      least = turn;
      best = description;
    }
  }
  return best;
}

Nees full_nees(const Patch& fitted, const Patch& truth) {
  return nees(local_error(fitted, nearest_description(fitted, truth)), cov_local(fitted));
}

Nees surface_nees(const Patch& fitted, const Patch& truth) {
  const Patch near = nearest_description(fitted, truth);
  switch (fitted.type->surface) {
    case SurfaceType::plane:
      return plane_nees(fitted, near);
    case SurfaceType::sphere:
      return sphere_nees(fitted, near);
    case SurfaceType::circular_cylinder:
      return cylinder_nees(fitted, near);
    case SurfaceType::cylindric_paraboloid:
      return cylindric_nees(fitted, near);
    case SurfaceType::circular_paraboloid:
      return picked(fitted, local_error(fitted, near), {1, 2, 3, 4, 5, 6});
    case SurfaceType::elliptic_paraboloid:
    case SurfaceType::hyperbolic_paraboloid:
      return picked(fitted, local_error(fitted, near), {2, 3, 4, 5, 6, 7, 8, 9});
  }
  return {};
}

std::vector<std::string> surface_error_names(SurfaceType surface) {
  switch (surface) {
    case SurfaceType::plane:
      return {"w_x", "w_y", "t_z"};
    case SurfaceType::sphere:
      return {"kappa", "n_x", "n_y", "t_z"};
    case SurfaceType::circular_cylinder:
      return {"kappa", "w_z", "w_y", "n_y", "t_z"};
    case SurfaceType::cylindric_paraboloid:
      return {"kappa", "w_x", "w_y", "w_z", "t_y", "t_z"};
    case SurfaceType::circular_paraboloid:
      return {"kappa", "tilt_x", "tilt_y", "t_x", "t_y", "t_z"};
    case SurfaceType::elliptic_paraboloid:
    case SurfaceType::hyperbolic_paraboloid:
      return {"kappa_x", "kappa_y", "w_x", "w_y", "w_z", "t_x", "t_y", "t_z"};
  }
  return {};
}

}  // namespace patchlab::test
