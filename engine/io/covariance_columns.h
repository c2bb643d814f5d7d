// Covariances of points, in the ways files carry them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/io/columns.h"
#include "engine/scan/scan.h"

namespace patchlab {

// What the covariances of a file are expressed in.
struct CovarianceFrame {
  Eigen::Matrix3d points_from_file = Eigen::Matrix3d::Identity();  // rotation
  std::span<const Eigen::Vector3d> rays;  // from the sensor to each point, in the frame of the points
};

bool is_covariance_column(std::string_view name);

// One covariance a point, m^2, in the frame of the points, from the first of these that the columns hold:
// cov_xx cov_xy cov_xz cov_yy cov_yz cov_zz; cxx ... czz; `covariance` of 6 (upper triangle) or 9 (row by
// row) values; standard deviations in metre, `sigma` or `sigma_range` with `sigma_lateral`. Empty where there
// is none of them. unreadable error for half a covariance and for one that is not symmetric; whether it is
// positive is judged by judge_covariances, and refused where it is used.
Result<std::vector<Covariance6>> read_covariances(std::span<const Column> columns,
                                                  const CovarianceFrame& frame, const std::string& file);

// How the covariances of finite points stand. An eigenvalue below zero by no more than 1e-6 of the trace is
// rounding: it is set to zero. Below that, or where an entry is not finite, the covariance is bad: it stays
// as it is, and a fit that meets it is refused.
struct CovarianceCount {
  std::size_t clamped = 0, bad = 0;
};
CovarianceCount judge_covariances(std::vector<Covariance6>& covariances,
                                  const std::vector<std::uint8_t>& finite);

}  // namespace patchlab
