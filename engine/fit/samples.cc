#include "engine/fit/samples.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

namespace patchlab {
namespace {

constexpr double no_extent = 1e-12;  // share of a covariance's trace below which a variance counts as none

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

// Nearly all are: finite, symmetric, with extent in every direction. Written so that what is
// not finite is not.
bool is_clearly_good(const Eigen::Vector3d& point, const Eigen::Matrix3d& cov) {
  constexpr double clearly = 1e-9;
  const double xx = cov(0, 0), xy = cov(1, 0), xz = cov(2, 0), yy = cov(1, 1), yz = cov(2, 1), zz = cov(2, 2);
  const double trace = xx + yy + zz, minor = xx * yy - xy * xy;
  const double determinant = zz * minor - yz * (xx * yz - xy * xz) + xz * (xy * yz - yy * xz);
  const double apart = std::abs(cov(0, 1) - xy) + std::abs(cov(0, 2) - xz) + std::abs(cov(1, 2) - yz);
  const bool extended =
      (xx > 0.0) & (minor > clearly * trace * trace) & (4.0 * determinant > clearly * trace * trace * trace);
  return (apart <= 0.1 * clearly * trace) & extended & (point.sum() - point.sum() == 0.0);
}

// What is wrong with a sample; nothing where it is good. Counts those without extent in some direction.
const char* fault_of(const Eigen::Vector3d& point, const Eigen::Matrix3d& cov, std::size_t& semidefinite) {
  if (!point.allFinite()) return "its position is not finite; remove it.";
  if (!cov.allFinite()) return "its covariance is not finite.";
  const double size = cov.cwiseAbs().maxCoeff();
  if ((cov - cov.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) return "its covariance is not symmetric.";
  const double least = cov.trace() > 0.0 ? thinnest(cov) : -1.0;
  if (least < -1e-9) {
    return "its covariance is not positive semi-definite; check the noise model or the file's columns.";
  }
  if (least < no_extent) ++semidefinite;
  return nullptr;
}

// How many covariances are semidefinite.
Result<std::size_t> check_samples(const Observations& observations) {
  std::size_t semidefinite = 0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Eigen::Vector3d& point = observations.points[i];
    const Eigen::Matrix3d& cov = observations.covariances[i];
    if (is_clearly_good(point, cov)) continue;
    const char* fault = fault_of(point, cov, semidefinite);
    if (fault != nullptr) return no_fit("Point " + std::to_string(i) + " (counted from 0): " + fault);
  }
  return semidefinite;
}

// Spread of the points in units of their noise, largest first, and the extent itself.
struct Spread {
  Eigen::Vector3d against_noise;  // generalised eigenvalues of (sample covariance, mean covariance)
  Eigen::Vector3d extent;         // m, standard deviations
};

Spread spread_of(const Samples& samples) {
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  for (const Eigen::Matrix3d& cov : samples.cov) noise += cov;
  const Eigen::Matrix3d scatter = samples.scatter / static_cast<double>(samples.size());
  noise /= static_cast<double>(samples.size());
  const double floor = 1e-12 * scatter.trace() + 1e-300;
  noise.diagonal().array() += 1e-6 * noise.trace() + floor;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> against(scatter, noise,
                                                                          Eigen::EigenvaluesOnly);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> plain(scatter, Eigen::EigenvaluesOnly);
  return {against.eigenvalues().reverse(), plain.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt()};
}

Eigen::Matrix3d scatter_of(const std::vector<Eigen::Vector3d>& points) {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;  // in registers
  for (const Eigen::Vector3d& q : points) {
    xx += q.x() * q.x(), xy += q.x() * q.y(), xz += q.x() * q.z();
    yy += q.y() * q.y(), yz += q.y() * q.z(), zz += q.z() * q.z();
  }
  return (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

// Keeps their scatter and extent.
Result<void> check_spread(Samples& samples) {
  constexpr double least_spread = 9.0;  // method M10
  constexpr double least_aspect = 1e-3;
  samples.scatter = scatter_of(samples.q);
  const Spread spread = spread_of(samples);
  samples.extent = spread.extent.norm();
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

void put_cov(Samples& samples, std::size_t i) {
  const Eigen::Matrix3d& cov = samples.cov[i];
  const double entries[] = {cov(0, 0), cov(1, 0), cov(2, 0), cov(1, 1), cov(2, 1), cov(2, 2)};
  const std::size_t last = i + 1 < samples.size() ? i + 1 : block_size * samples.blocks.size();
  for (std::size_t at = i; at < last; ++at) {
    for (std::size_t entry = 0; entry < 6; ++entry) {
      samples.blocks[at / block_size].cov[entry][at % block_size] = entries[entry];
    }
  }
}

// The last block is filled up with the last sample.
void fill_block(const Samples& samples, std::size_t first, SampleBlock& block) {
  const std::size_t last = samples.size() - 1;
  for (std::size_t i = 0; i < block_size; ++i) {
    const std::size_t from = std::min(first + i, last);
    const Eigen::Vector3d& q = samples.q[from];
    const double* cov = samples.cov[from].data();
    for (const int axis : {0, 1, 2}) block.q[axis][i] = q[axis];
    block.cov[0][i] = cov[0];
    block.cov[1][i] = cov[1];
    block.cov[2][i] = cov[2];
    block.cov[3][i] = cov[4];
    block.cov[4][i] = cov[5];
    block.cov[5][i] = cov[8];
  }
}

void fill_blocks(Samples& samples) {
  samples.blocks.resize((samples.size() + block_size - 1) / block_size);
  for (std::size_t b = 0; b < samples.blocks.size(); ++b) {
    fill_block(samples, b * block_size, samples.blocks[b]);
  }
  for (std::size_t i = 0; samples.semidefinite > 0 && i < samples.size(); ++i) {
    if (thinnest(samples.cov[i]) < no_extent) samples.blocks[i / block_size].thin = true;
  }
}

}  // namespace

void Samples::set_cov(std::size_t i, const Eigen::Matrix3d& cov_i) {
  cov[i] = cov_i;
  put_cov(*this, i);
  if (thinnest(cov_i) < no_extent) blocks[i / block_size].thin = true;
}

bool Samples::all_count(std::size_t first, std::size_t count) const {
  std::uint64_t other = 0;  // without an early end, so that the loop is one of vector instructions
  for (std::size_t i = first; i < first + count; ++i)
    other |= std::bit_cast<std::uint64_t>(robust[i]) ^ std::bit_cast<std::uint64_t>(1.0);
  return other == 0 && std::memchr(bends.data() + first, 0, count) == nullptr;
}

Eigen::Vector3d Samples::mean_viewpoint() const {
  const std::vector<Eigen::Vector3d>& viewpoints = observations->viewpoints;
  if (viewpoints.empty()) return viewpoint(0);
  const Eigen::Vector3d sum =
      std::accumulate(viewpoints.begin(), viewpoints.end(), Eigen::Vector3d(0.0, 0.0, 0.0));
  return sum / static_cast<double>(size()) - origin;
}

Result<Samples> make_samples(const Observations& observations, std::size_t least) {
  const std::size_t n = observations.size();
  if (n < least) {
    return no_fit("Too few points: " + std::to_string(n) + " where this surface needs at least " +
                  std::to_string(least) + "; select a larger region.");
  }
  Samples samples;
  const Result<std::size_t> semidefinite = check_samples(observations);
  if (!semidefinite) return semidefinite.error();
  samples.semidefinite = *semidefinite;
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
