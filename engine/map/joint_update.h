// Kalman update of many patches that were measured through one shared, uncertain pose.
//
// Errors: x_i of patch i in its local chart (independent, covariance P_i), and delta of the shared pose's (r,
// t). Each measurement says y_i = H_i x_i + G_i delta + noise of covariance R_i. All are solved together:
// delta is known from all of them, and the covariance of every patch holds what is left of its error. Patches
// are correlated through delta afterwards: the covariance of patches i and j is C_i cov_delta C_j' (less the
// square of what P_gain and R_gain take from their gains).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/patch/patch.h"

namespace patchlab {

struct Measurement {
  PatchMatrix P;
  Eigen::VectorXd y;
  Eigen::MatrixXd H;  // rows of y x chart
  Eigen::Matrix<double, Eigen::Dynamic, 6> G;
  Eigen::MatrixXd R;
  Eigen::Matrix<double, Eigen::Dynamic, 6> T;  // the patch stands in the map as x + T delta
  // What the gain takes P and R for, where that is another: less than P where this is not to teach some of x,
  // R as engine/map/weigh.h says. P and R stay what the errors are.
  PatchMatrix P_gain = {};
  Eigen::MatrixXd R_gain = {};
};

struct SharedError {
  Vector6d mean = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();  // may be singular, or zero for a known pose
};

struct Updated {
  PatchVector x;  // estimate of x + T delta
  PatchMatrix P;  // its covariance
  Eigen::Matrix<double, Eigen::Dynamic, 6> C;
  double chi2 = 0.0;  // of this measurement's residual, by its own covariance
};

struct JointUpdate {
  SharedError delta;
  std::vector<Updated> patches;  // in the order of the measurements
  double chi2 = 0.0;             // of all measurements together
  int dof = 0;
};

// Precondition: H P H' + R is positive definite for every measurement (R alone may be semi-definite).
JointUpdate update_jointly(const std::vector<Measurement>& measurements, const SharedError& prior);

// The covariance without what joins the bounds to the surface: bounds are no part of the state.
PatchMatrix bounds_apart(const PatchTypeRow& type, const PatchMatrix& covariance_local);

}  // namespace patchlab
