// The points of a fit as its inner loops read them: about their mean, with what each step adds to them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/fit/observation.h"
#include "engine/fit/rows.h"

namespace patchlab {

struct Samples {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   // m: mean of the points, added back at the end
  double extent = 0.0;                                // m: RMS distance of the points from origin
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();  // m^2: sum of q q' over all points
  std::size_t count = 0;
  std::vector<SampleBlock> blocks;             // q and cov of all, as the kernels read them
  std::size_t semidefinite = 0;                // covariances without extent in some direction
  std::vector<double> robust;                  // Tukey weight in [0, 1]; 1 where nothing is doubted
  std::vector<std::uint8_t> bends;             // 0 where a point counts for the outline alone (M13)
  const Observations* observations = nullptr;  // outlives the samples
  Progress progress = {};  // asked in every step of a fit: once it says stop, fits end where they are

  std::size_t size() const { return count; }
  Eigen::Vector3d q(std::size_t i) const {  // m, about origin
    const SampleBlock& block = blocks[i / block_size];
    const std::size_t at = i % block_size;
    return {block.q[0][at], block.q[1][at], block.q[2][at]};
  }
  Eigen::Matrix3d cov(std::size_t i) const;  // m^2, as measured or re-evaluated at the foot points
  Eigen::Matrix3d mean_cov() const;          // of all points
  // Whether all of these count, and count fully.
  bool all_count(std::size_t first, std::size_t how_many) const;
  void set_cov(std::size_t i, const Eigen::Matrix3d& cov_i);
  Eigen::Vector3d viewpoint(std::size_t i) const {  // m, about origin
    const Observations& o = *observations;
    return (o.viewpoints.empty() ? o.viewpoint : o.viewpoints[i]) - origin;
  }
  Eigen::Vector3d mean_viewpoint() const;  // of all points
};

// Checks of method M10: at least `least` points, every covariance finite, symmetric and positive
// semi-definite (named by its row), points that are neither coincident nor collinear within their noise.
// no_finite_fit otherwise. Points at depth edges are set aside from the surface where half of the points and
// three times `least` remain.
Result<Samples> make_samples(const Observations& observations, std::size_t least);

}  // namespace patchlab
