// Residuals and rows of a fit's samples, a block at a time, by the fastest kernel of this machine.
#pragma once

#include <span>

#include "engine/fit/distance.h"
#include "engine/fit/samples.h"

namespace patchlab {

// A surface before the samples: what its kernels read of it.
class SampleRows {
 public:
  SampleRows(const Samples& samples, const SurfaceModel& model, const SurfaceState& state, Distance distance,
             const RowKernel& kernel = fastest_rows());

  std::size_t blocks() const { return samples_.blocks.size(); }
  // Samples of a block: block_size but in the last one.
  std::size_t count(std::size_t block) const;
  // Where the kernel finds no foot point, what `residual` says; rows of 0 to the end of the last lanes.
  void evaluate(std::size_t block, RowBlock& rows) const;
  Residual residual(const RowBlock& rows, std::size_t i) const;
  // Adds products of the free columns of F_p and of F.
  void add(const RowBlock& rows, std::size_t block, std::span<const int> free, RowSums& sums) const;

 private:
  std::size_t lanes_of(std::size_t block) const;  // count, in whole lanes

  const Samples& samples_;
  const SurfaceModel& model_;
  const SurfaceState& state_;
  Distance distance_;
  Vector3d kappa_;
  const RowKernel& kernel_;
  RowSurface surface_{};
};

// A, b and chi-square, Eq. (33), of rows that were added so.
NormalEquations normal_equations(const RowSums& sums, int free_size);

// All of a fit's samples in order: what(i, residual).
template <class What>
void for_each_residual(const SampleRows& rows, What&& what) {
  RowBlock block;
  for (std::size_t b = 0; b < rows.blocks(); ++b) {
    rows.evaluate(b, block);
    for (std::size_t i = 0; i < rows.count(b); ++i) what(b * block_size + i, rows.residual(block, i));
  }
}

}  // namespace patchlab
