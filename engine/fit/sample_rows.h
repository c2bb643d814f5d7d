// Residuals and rows of a fit's samples, a block at a time, by the fastest kernel of this machine.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "engine/base/parallel.h"
#include "engine/fit/distance.h"
#include "engine/fit/samples.h"

namespace patchlab {

// Parts that the samples of a large fit are shared out in; by their number alone, so that sums over them are
// the same on any number of threads.
inline constexpr std::size_t most_parts = 16, least_blocks_a_part = 14;

inline std::size_t blocks_a_part(std::size_t blocks) {  // of even parts, a power of two of them
  std::size_t parts = 1;
  while (2 * parts <= most_parts && 2 * parts * least_blocks_a_part <= blocks) parts *= 2;
  return chunk_count(std::max<std::size_t>(blocks, 1), parts);
}

// The sum of of_part(chunk of blocks), which runs on several threads at once.
template <class Sum, class OfPart>
Sum sum_over_parts(std::size_t blocks, const OfPart& of_part) {
  const std::size_t grain = blocks_a_part(blocks), parts = chunk_count(blocks, grain);
  if (parts == 1) return of_part(Chunk{0, 0, blocks});
  std::array<Sum, most_parts> of_parts;
  for_each_chunk(blocks, grain, [&](const Chunk& part) { of_parts[part.number] = of_part(part); });
  for (std::size_t part = 1; part < parts; ++part) of_parts[0] += of_parts[part];
  return of_parts[0];
}
template <class OfPart>
NormalEquations sum_of_parts(std::size_t blocks, const OfPart& of_part) {
  return sum_over_parts<NormalEquations>(blocks, of_part);
}

// A surface before the samples: what its kernels read of it.
class SampleRows {
 public:
  SampleRows(const Samples& samples, const SurfaceModel& model, const SurfaceState& state, Distance distance,
             const RowKernel& kernel = fastest_rows());

  std::size_t blocks() const { return samples_.blocks.size(); }
  std::size_t parts() const { return chunk_count(blocks(), blocks_a_part(blocks())); }
  // Samples of a block: block_size but in the last one.
  std::size_t count(std::size_t block) const;
  std::size_t lanes_of(std::size_t block) const;  // count, in whole lanes
  const RowSurface& surface() const { return surface_; }
  // Where the kernel finds no foot point, what `residual` says; rows of 0 to the end of the last lanes.
  void evaluate(std::size_t block, RowBlock& rows) const;
  Residual residual(const RowBlock& rows, std::size_t i) const;
  // Adds products of the free columns of F_p and of F.
  void add(const RowBlock& rows, std::size_t block, std::span<const int> free, RowSums& sums) const;

 private:
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

// All of a fit's samples, from several threads at once: what(i, residual, number of the part).
template <class What>
void for_each_residual_of_parts(const SampleRows& rows, const What& what) {
  for_each_chunk(rows.blocks(), blocks_a_part(rows.blocks()), [&](const Chunk& part) {
    RowBlock block;
    for (std::size_t b = part.first; b < part.last; ++b) {
      rows.evaluate(b, block);
      for (std::size_t i = 0; i < rows.count(b); ++i)
        what(b * block_size + i, rows.residual(block, i), part.number);
    }
  });
}

// what(i, residual) must write what belongs to i, or to its block, alone.
template <class What>
void for_each_residual(const SampleRows& rows, const What& what) {
  for_each_residual_of_parts(rows, [&](std::size_t i, const Residual& r, std::size_t) { what(i, r); });
}

// The sum of what each sample adds: what(i, residual, sum).
template <class Sum, class What>
Sum sum_of_residuals(const SampleRows& rows, const What& what) {
  Sum sum{};
  if (rows.parts() == 1) {
    for_each_residual(rows, [&](std::size_t i, const Residual& r) { what(i, r, sum); });
    return sum;
  }
  std::array<Sum, most_parts> of_parts{};
  for_each_residual_of_parts(
      rows, [&](std::size_t i, const Residual& r, std::size_t part) { what(i, r, of_parts[part]); });
  for (std::size_t part = 0; part < rows.parts(); ++part) sum += of_parts[part];
  return sum;
}

}  // namespace patchlab
