#include "engine/fit/samples.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <string>

namespace patchlab {
namespace {

Error no_fit(std::string sentence) { return {ErrorCode::no_finite_fit, std::move(sentence)}; }

// The least eigenvalue of a covariance as a share of its trace; at most that where it is clearly above 0. All
// three are positive where the leading minors are, and the least is then above 4 det / trace^2, since the
// other two multiply to less than trace^2 / 4.
double thinnest(const Eigen::Matrix3d& cov) {
  constexpr double clearly = 1e-9;
  const double trace = cov.trace(), minor = cov(0, 0) * cov(1, 1) - cov(1, 0) * cov(1, 0);
  const double bound = 4.0 * cov.determinant() / (trace * trace * trace);
  if (cov(0, 0) > 0.0 && minor > clearly * trace * trace && bound > clearly) return bound;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cov, Eigen::EigenvaluesOnly).eigenvalues()[0] / trace;
}

// What is wrong with a sample; nothing where it is good.
const char* fault_of(const Eigen::Vector3d& point, const Eigen::Matrix3d& cov) {
  if (!point.allFinite()) return "its position is not finite; remove it.";
  if (!cov.allFinite()) return "its covariance is not finite.";
  const double size = cov.cwiseAbs().maxCoeff();
  if ((cov - cov.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) return "its covariance is not symmetric.";
  if (cov.trace() <= 0.0 || thinnest(cov) < -1e-9) {
    return "its covariance is not positive semi-definite; check the noise model or the file's columns.";
  }
  return nullptr;
}

Result<void> check_samples(const Observations& observations) {
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const char* fault = fault_of(observations.points[i], observations.covariances[i]);
    if (fault != nullptr) return no_fit("Point " + std::to_string(i) + " (counted from 0): " + fault);
  }
  return {};
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

// The last block is filled up with the last sample.
void fill_blocks(Samples& samples) {
  samples.blocks.resize((samples.size() + block_size - 1) / block_size);
  for (std::size_t i = 0; i < block_size * samples.blocks.size(); ++i) {
    const std::size_t from = std::min(i, samples.size() - 1);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      samples.blocks[i / block_size].q[axis][i % block_size] = samples.q[from][axis];
    }
  }
  for (std::size_t i = 0; i < samples.size(); ++i) samples.set_cov(i, samples.cov[i]);
}

}  // namespace

void Samples::set_cov(std::size_t i, const Eigen::Matrix3d& cov_i) {
  cov[i] = cov_i;
  const double entries[] = {cov_i(0, 0), cov_i(1, 0), cov_i(2, 0), cov_i(1, 1), cov_i(2, 1), cov_i(2, 2)};
  const std::size_t last = i + 1 < size() ? i + 1 : block_size * blocks.size();
  for (std::size_t at = i; at < last; ++at) {
    for (std::size_t entry = 0; entry < 6; ++entry) {
      blocks[at / block_size].cov[entry][at % block_size] = entries[entry];
    }
  }
}

Result<Samples> make_samples(const Observations& observations, std::size_t least) {
  const std::size_t n = observations.size();
  if (n < least) {
    return no_fit("Too few points: " + std::to_string(n) + " where this surface needs at least " +
                  std::to_string(least) + "; select a larger region.");
  }
  Samples samples;
  const Result<void> sound = check_samples(observations);
  if (!sound) return sound.error();
  samples.semidefinite = static_cast<std::size_t>(
      std::count_if(observations.covariances.begin(), observations.covariances.end(),
                    [](const Eigen::Matrix3d& cov) { return thinnest(cov) < 1e-12; }));
  samples.observations = &observations;
  for (const Eigen::Vector3d& point : observations.points) samples.origin += point;
  samples.origin /= static_cast<double>(n);
  samples.q.reserve(n);
  for (const Eigen::Vector3d& point : observations.points) samples.q.push_back(point - samples.origin);
  samples.cov = observations.covariances;
  fill_blocks(samples);
  samples.robust.assign(n, 1.0);
  set_edges_aside(samples, least);
  const Result<void> good = check_spread(samples);
  if (!good) return good.error();
  return samples;
}

}  // namespace patchlab
