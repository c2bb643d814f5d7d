#include "engine/fit/samples.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <string>

namespace patchlab {
namespace {

Error no_fit(std::string sentence) { return {ErrorCode::no_finite_fit, std::move(sentence)}; }

// The least eigenvalue of the covariance, as a share of its trace.
Result<double> check_sample(const Observations& observations, std::size_t i) {
  const std::string row = "Point " + std::to_string(i) + " (counted from 0): ";
  if (!observations.points[i].allFinite()) return no_fit(row + "its position is not finite; remove it.");
  const Eigen::Matrix3d& cov = observations.covariances[i];
  if (!cov.allFinite()) return no_fit(row + "its covariance is not finite.");
  const double size = cov.cwiseAbs().maxCoeff();
  if ((cov - cov.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) {
    return no_fit(row + "its covariance is not symmetric.");
  }
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cov, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (least < -1e-9 * cov.trace() || cov.trace() <= 0.0) {
    return no_fit(
        row + "its covariance is not positive semi-definite; check the noise model or the file's columns.");
  }
  return least / cov.trace();
}

// Spread of the points in units of their noise, largest first, and the extent itself.
struct Spread {
  Eigen::Vector3d against_noise;  // generalised eigenvalues of (sample covariance, mean covariance)
  Eigen::Vector3d extent;         // m, standard deviations
};

Spread spread_of(const Samples& samples) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero(), noise = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    scatter += samples.q[i] * samples.q[i].transpose();
    noise += samples.cov[i];
  }
  scatter /= static_cast<double>(samples.size());
  noise /= static_cast<double>(samples.size());
  const double floor = 1e-12 * scatter.trace() + 1e-300;
  noise.diagonal().array() += 1e-6 * noise.trace() + floor;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> against(scatter, noise,
                                                                          Eigen::EigenvaluesOnly);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> plain(scatter, Eigen::EigenvaluesOnly);
  return {against.eigenvalues().reverse(), plain.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt()};
}

Result<void> check_spread(const Samples& samples) {
  constexpr double least_spread = 9.0;  // method M10
  constexpr double least_aspect = 1e-3;
  const Spread spread = spread_of(samples);
  if (spread.extent[0] == 0.0 || spread.against_noise[0] < least_spread) {
    return no_fit(
        "The points coincide within their noise: they do not span a surface; select a larger region.");
  }
  if (spread.extent[1] < least_aspect * spread.extent[0] || spread.against_noise[1] < least_spread) {
    return no_fit(
        "The points lie on a line within their noise: they do not span a surface; select a wider region.");
  }
  return {};
}

void set_edges_aside(Samples& samples, std::size_t least) {
  samples.bends.assign(samples.size(), 1);
  const std::vector<std::uint8_t>& at_edge = samples.observations->at_edge;
  const auto inner = static_cast<std::size_t>(std::count(at_edge.begin(), at_edge.end(), 0));
  if (inner < 3 * least || 2 * inner < samples.size()) return;
  for (std::size_t i = 0; i < samples.size(); ++i) samples.bends[i] = at_edge[i] == 0 ? 1 : 0;
}

}  // namespace

Result<Samples> make_samples(const Observations& observations, std::size_t least) {
  const std::size_t n = observations.size();
  if (n < least) {
    return no_fit("Too few points: " + std::to_string(n) + " where this surface needs at least " +
                  std::to_string(least) + "; select a larger region.");
  }
  Samples samples;
  for (std::size_t i = 0; i < n; ++i) {
    const Result<double> thinnest = check_sample(observations, i);
    if (!thinnest) return thinnest.error();
    if (*thinnest < 1e-12) ++samples.semidefinite;
  }
  samples.observations = &observations;
  for (const Eigen::Vector3d& point : observations.points) samples.origin += point;
  samples.origin /= static_cast<double>(n);
  samples.q.reserve(n);
  for (const Eigen::Vector3d& point : observations.points) samples.q.push_back(point - samples.origin);
  samples.cov = observations.covariances;
  samples.robust.assign(n, 1.0);
  set_edges_aside(samples, least);
  const Result<void> good = check_spread(samples);
  if (!good) return good.error();
  return samples;
}

}  // namespace patchlab
