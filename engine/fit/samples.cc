#include "engine/fit/samples.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
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

// What is wrong with a sample; nothing where it is good, as it may be without extent in some direction.
struct Checked {
  const char* fault = nullptr;
  bool semidefinite = false;
};
Checked check(const Eigen::Vector3d& point, const Eigen::Matrix3d& cov) {
  if (!point.allFinite()) return {"its position is not finite; remove it."};
  if (!cov.allFinite()) return {"its covariance is not finite."};
  const double size = cov.cwiseAbs().maxCoeff();
  if ((cov - cov.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size)
    return {"its covariance is not symmetric."};
  const double least = cov.trace() > 0.0 ? thinnest(cov) : -1.0;
  if (least < -1e-9) {
    return {"its covariance is not positive semi-definite; check the noise model or the file's columns."};
  }
  return {nullptr, least < no_extent};
}

// A block of observations on its way to the kernels, and how far their covariances are from symmetric. The
// last block is filled up with the last sample.
struct Filling {
  SampleBlock& block;
  double apart[block_size];
};
void fill(const Observations& observations, const Eigen::Vector3d& origin, std::size_t first,
          Filling& filling) {
  SampleBlock& block = filling.block;
  for (std::size_t i = 0; i < block_size; ++i) {
    const std::size_t from = std::min(first + i, observations.size() - 1);
    const Eigen::Vector3d& point = observations.points[from];
    const double* cov = observations.covariances[from].data();
    for (const int axis : {0, 1, 2}) block.q[axis][i] = point[axis] - origin[axis];
    block.cov[0][i] = cov[0];
    block.cov[1][i] = cov[1];
    block.cov[2][i] = cov[2];
    block.cov[3][i] = cov[4];
    block.cov[4][i] = cov[5];
    block.cov[5][i] = cov[8];
    filling.apart[i] = std::abs(cov[3] - cov[1]) + std::abs(cov[6] - cov[2]) + std::abs(cov[7] - cov[5]);
  }
}

// Nearly all are: finite, symmetric, with extent in every direction. What is not finite is not.
bool all_clearly_good(const Filling& filling) {
  constexpr double clearly = 1e-9;
  const auto& [q, cov, thin] = filling.block;
  double doubts[block_size];  // of each, counted; a loop of vector instructions
  for (std::size_t i = 0; i < block_size; ++i) {
    const double xx = cov[0][i], xy = cov[1][i], xz = cov[2][i], yy = cov[3][i], yz = cov[4][i],
                 zz = cov[5][i];
    const double trace = xx + yy + zz, minor = xx * yy - xy * xy;
    const double determinant = zz * minor - yz * (xx * yz - xy * xz) + xz * (xy * yz - yy * xz);
    const double sum = q[0][i] + q[1][i] + q[2][i], least = clearly * trace * trace;
    doubts[i] = (xx > 0.0 ? 0.0 : 1.0) + (minor > least ? 0.0 : 1.0) +
                (4.0 * determinant > least * trace ? 0.0 : 1.0) + (sum - sum == 0.0 ? 0.0 : 1.0) +
                (filling.apart[i] <= 0.1 * clearly * trace ? 0.0 : 1.0);
  }
  return Eigen::Map<const Eigen::ArrayXd>(doubts, block_size).sum() == 0.0;
}

// Fills the blocks, and tells what is wrong with the first sample that is wrong.
Result<void> take(const Observations& observations, Samples& samples) {
  samples.count = observations.size();
  samples.blocks.reserve((samples.count + block_size - 1) / block_size);
  for (std::size_t first = 0; first < samples.count; first += block_size) {
    Filling filling{samples.blocks.emplace_back(), {}};
    filling.block.thin = false;
    fill(observations, samples.origin, first, filling);
    if (all_clearly_good(filling)) continue;
    for (std::size_t i = first; i < std::min(first + block_size, samples.count); ++i) {
      const Checked checked = check(observations.points[i], observations.covariances[i]);
      if (checked.fault != nullptr)
        return no_fit("Point " + std::to_string(i) + " (counted from 0): " + checked.fault);
      if (!checked.semidefinite) continue;
      filling.block.thin = true;
      ++samples.semidefinite;
    }
  }
  return {};
}

// what(block, how many of its samples there are).
template <class What>
void for_each_block(const Samples& samples, const What& what) {
  for (std::size_t b = 0; b < samples.blocks.size(); ++b)
    what(samples.blocks[b], std::min(block_size, samples.count - b * block_size));
}

Eigen::Map<const Eigen::VectorXd, Eigen::Aligned64> head(const double (&row)[block_size], std::size_t count) {
  return {row, static_cast<Eigen::Index>(count)};
}

Eigen::Matrix3d symmetric(const std::array<double, 6>& lower) {
  const auto& [xx, xy, xz, yy, yz, zz] = lower;
  return (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

// Spread of the points in units of their noise, largest first, and the extent itself.
struct Spread {
  Eigen::Vector3d against_noise;  // generalised eigenvalues of (sample covariance, mean covariance)
  Eigen::Vector3d extent;         // m, standard deviations
};

Spread spread_of(const Samples& samples) {
  Eigen::Matrix3d noise = samples.mean_cov();
  const Eigen::Matrix3d scatter = samples.scatter / static_cast<double>(samples.size());
  const double floor = 1e-12 * scatter.trace() + 1e-300;
  noise.diagonal().array() += 1e-6 * noise.trace() + floor;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> against(scatter, noise,
                                                                          Eigen::EigenvaluesOnly);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> plain(scatter, Eigen::EigenvaluesOnly);
  return {against.eigenvalues().reverse(), plain.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt()};
}

Eigen::Matrix3d scatter_of(const Samples& samples) {
  std::array<double, 6> sums{};
  for_each_block(samples, [&](const SampleBlock& block, std::size_t count) {
    const auto x = head(block.q[0], count), y = head(block.q[1], count), z = head(block.q[2], count);
    const double products[] = {x.dot(x), x.dot(y), x.dot(z), y.dot(y), y.dot(z), z.dot(z)};
    for (std::size_t i = 0; i < 6; ++i) sums[i] += products[i];
  });
  return symmetric(sums);
}

// Keeps their scatter and extent.
Result<void> check_spread(Samples& samples) {
  constexpr double least_spread = 9.0;  // method M10
  constexpr double least_aspect = 1e-3;
  samples.scatter = scatter_of(samples);
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

}  // namespace

Eigen::Matrix3d Samples::cov(std::size_t i) const {
  const auto& rows = blocks[i / block_size].cov;
  const std::size_t at = i % block_size;
  return symmetric({rows[0][at], rows[1][at], rows[2][at], rows[3][at], rows[4][at], rows[5][at]});
}

Eigen::Matrix3d Samples::mean_cov() const {
  std::array<double, 6> sums{};
  for_each_block(*this, [&](const SampleBlock& block, std::size_t of_block) {
    for (std::size_t entry = 0; entry < 6; ++entry) sums[entry] += head(block.cov[entry], of_block).sum();
  });
  return symmetric(sums) / static_cast<double>(count);
}

void Samples::set_cov(std::size_t i, const Eigen::Matrix3d& cov_i) {
  SampleBlock& block = blocks[i / block_size];
  const double entries[] = {cov_i(0, 0), cov_i(1, 0), cov_i(2, 0), cov_i(1, 1), cov_i(2, 1), cov_i(2, 2)};
  const std::size_t at = i % block_size, last = i + 1 < count ? at + 1 : block_size;
  for (std::size_t entry = 0; entry < 6; ++entry)
    std::fill(block.cov[entry] + at, block.cov[entry] + last, entries[entry]);
  if (!(thinnest(cov_i) >= no_extent)) block.thin = true;  // nor where it is none at all
}

bool Samples::all_count(std::size_t first, std::size_t how_many) const {
  std::uint64_t other = 0;  // without an early end, so that the loop is one of vector instructions
  for (std::size_t i = first; i < first + how_many; ++i)
    other |= std::bit_cast<std::uint64_t>(robust[i]) ^ std::bit_cast<std::uint64_t>(1.0);
  return other == 0 && std::memchr(bends.data() + first, 0, how_many) == nullptr;
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
  samples.observations = &observations;
  for (const Eigen::Vector3d& point : observations.points) samples.origin += point;
  samples.origin /= static_cast<double>(n);
  if (const Result<void> taken = take(observations, samples); !taken) return taken.error();
  samples.robust.assign(n, 1.0);
  set_edges_aside(samples, least);
  const Result<void> good = check_spread(samples);
  if (!good) return good.error();
  return samples;
}

}  // namespace patchlab
