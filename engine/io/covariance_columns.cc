#include "engine/io/covariance_columns.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/io/read_error.h"

namespace patchlab {
namespace {

using Covariances = std::vector<Covariance6>;
using Names6 = std::array<std::string_view, 6>;

constexpr double symmetry_tolerance = 1e-6;
constexpr Names6 component_names[] = {{"cov_xx", "cov_xy", "cov_xz", "cov_yy", "cov_yz", "cov_zz"},
                                      {"cxx", "cxy", "cxz", "cyy", "cyz", "czz"}};
constexpr std::string_view other_names[] = {"covariance", "sigma", "sigma_range", "sigma_lateral"};

Eigen::Matrix3d matrix(const Covariance6& c) {
  return (Eigen::Matrix3d() << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]).finished();
}
Covariance6 upper_triangle(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

Covariances from_components(const std::array<const Column*, 6>& components, const CovarianceFrame& frame) {
  Covariances covariances(frame.rays.size());
  for (std::size_t k = 0; k < 6; ++k)
    gather(*components[k], covariances.size(), 0, covariances[0].data() + k, 6);
  const Eigen::Matrix3d& R = frame.points_from_file;
  if (R.isIdentity(0.0)) return covariances;
  for (Covariance6& covariance : covariances)
    covariance = upper_triangle(R * matrix(covariance) * R.transpose());
  return covariances;
}

// Sigma = sigma_lateral^2 I + (sigma_range^2 - sigma_lateral^2) w w', w the direction of the ray.
Covariances from_deviations(const Column& range, const Column& lateral, const CovarianceFrame& frame) {
  const std::vector<double> along = values(range, frame.rays.size()),
                            across = values(lateral, frame.rays.size());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Covariances covariances(frame.rays.size());
  for (std::size_t i = 0; i < covariances.size(); ++i) {
    if (along[i] < 0.0 || across[i] < 0.0) {
      covariances[i].fill(nan);  // no deviation, so no covariance
      continue;
    }
    const Eigen::Vector3d w = frame.rays[i].normalized();
    const double variance = across[i] * across[i];
    covariances[i] = upper_triangle(variance * Eigen::Matrix3d::Identity() +
                                    (along[i] * along[i] - variance) * w * w.transpose());
  }
  return covariances;
}

std::optional<std::size_t> first_asymmetric(const Column& column, std::size_t points) {
  constexpr std::array<std::array<std::uint32_t, 2>, 3> mirrored = {{{1, 3}, {2, 6}, {5, 7}}};
  for (const auto& [above, below] : mirrored) {
    const std::vector<double> a = values(column, points, above), b = values(column, points, below);
    for (std::size_t i = 0; i < points; ++i) {
      if (std::abs(a[i] - b[i]) > symmetry_tolerance * (std::abs(a[i]) + std::abs(b[i]))) return i;
    }
  }
  return std::nullopt;
}

Result<Covariances> from_one_field(const Column& column, const CovarianceFrame& frame,
                                   const std::string& file) {
  if (column.count != 6 && column.count != 9) {
    return unreadable(
        file, "field 'covariance' has " + std::to_string(column.count) + " values a point, not 6 or 9.");
  }
  if (column.count == 9) {
    if (const auto point = first_asymmetric(column, frame.rays.size())) {
      return unreadable(file, "the covariance of point " + std::to_string(*point) + " is not symmetric.");
    }
  }
  constexpr std::array<std::uint32_t, 6> upper_of_9 = {0, 1, 2, 4, 5, 8};
  std::array<Column, 6> parts;
  std::array<const Column*, 6> components{};
  for (std::uint32_t k = 0; k < 6; ++k) {
    parts[k] = column;
    parts[k].first += (column.count == 9 ? upper_of_9[k] : k) * size_of(column.type);
    components[k] = &parts[k];
  }
  return from_components(components, frame);
}

// Is the shifted matrix positive: does it have a Cholesky factor?
bool positive_above(const Eigen::Matrix3d& cov, double shift) {
  const Eigen::Matrix3d shifted = cov + shift * Eigen::Matrix3d::Identity();
  return shifted.llt().info() == Eigen::Success;
}

Eigen::Matrix3d clamped(const Eigen::Matrix3d& cov) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(cov);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).asDiagonal() *
         axes.eigenvectors().transpose();
}

}  // namespace

CovarianceCount judge_covariances(std::vector<Covariance6>& covariances,
                                  const std::vector<std::uint8_t>& finite) {
  constexpr double rounding = 1e-6, nothing = 1e-12;  // of the trace
  CovarianceCount count;
  for (std::size_t i = 0; i < covariances.size(); ++i) {
    const Eigen::Matrix3d cov = matrix(covariances[i]);
    if (!finite[i] || cov.isZero(0.0)) continue;
    const double trace = cov.trace();
    if (!cov.allFinite() || trace <= 0.0 || !positive_above(cov, rounding * trace)) {
      ++count.bad;
    } else if (!positive_above(cov, nothing * trace)) {
      covariances[i] = upper_triangle(clamped(cov));
      ++count.clamped;
    }
  }
  return count;
}

bool is_covariance_column(std::string_view name) {
  return std::ranges::find(other_names, name) != std::end(other_names) ||
         std::ranges::any_of(component_names, [&](const Names6& names) {
           return std::ranges::find(names, name) != names.end();
         });
}

Result<std::vector<Covariance6>> read_covariances(std::span<const Column> columns,
                                                  const CovarianceFrame& frame, const std::string& file) {
  for (const Names6& names : component_names) {
    const auto found = find_columns(columns, names);
    if (is_complete(found)) return from_components(found, frame);
    const auto missing = std::ranges::find(found, nullptr);
    if (std::ranges::count(found, nullptr) == 6) continue;
    return unreadable(file, "a covariance takes six fields; '" +
                                std::string(names[static_cast<std::size_t>(missing - found.begin())]) +
                                "' is missing.");
  }
  if (const Column* column = find_column(columns, "covariance")) return from_one_field(*column, frame, file);
  if (const auto [sigma] = find_columns<1>(columns, {"sigma"}); sigma != nullptr) {
    return from_deviations(*sigma, *sigma, frame);
  }
  const auto deviations = find_columns<2>(columns, {"sigma_range", "sigma_lateral"});
  if (is_complete(deviations)) return from_deviations(*deviations[0], *deviations[1], frame);
  return Covariances{};
}

}  // namespace patchlab
