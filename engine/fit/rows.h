// Residuals and their rows F_p, Eqs. (34)-(36), of many samples at once: the innermost loop of every fit, for
// whatever vector instructions the machine has.
//
// All kernels compile the same lines (rows_kernel.h) and keep sums over the same eight lanes. Those of AVX2
// and AVX-512 fuse the same products and sums, and give the same bytes; the plain one rounds between them,
// and agrees to 1e-12. engine/fit/distance.h says the same one sample at a time, in the words of the paper;
// the tests hold the kernels to it.
//
// The kernels see plain numbers only. Nothing inline of Eigen or of the standard library may be compiled for
// one machine's instructions, where the linker could take it for all.
#pragma once

#include <cstddef>

namespace patchlab {

inline constexpr std::size_t lane_count = 8;
inline constexpr std::size_t block_size = 64;  // samples whose rows stay in the first-level cache
inline constexpr int row_count = 9;            // F_p in the chart's eight coordinates, then F

constexpr std::size_t whole_lanes(std::size_t samples) {
  return (samples + lane_count - 1) / lane_count * lane_count;
}

// The surface in the order of the chart: q_local = R' (q - c), k3 = B k.
struct RowSurface {
  double R[3][3];
  double c[3];
  double k3[3];
  double B[3][2];
};

// Samples side by side, in the frame of the points.
struct alignas(64) SampleBlock {
  SampleBlock() {}            // as it comes: what fills it fills all
  double q[3][block_size];    // m
  double cov[6][block_size];  // xx xy xz yy yz zz, m^2
  bool thin;                  // some covariance may have no extent in some direction
};

struct alignas(64) RowBlock {
  double row[row_count][block_size];
  double x[3][block_size];    // foot points (exact) or the samples themselves (paper), local
  double sigma[block_size];   // sqrt(g' S g): F_q = g / sigma
  double failed[block_size];  // of exact rows: not 0 where no foot point was found; the rest says nothing
};

// Sums of products of rows, three by three: tile (I, J) of up to three groups of three rows, lane by lane.
struct alignas(64) RowSums {
  RowSums() {}
  double tile[6][9][lane_count];  // says nothing before something was added
  bool empty = true;
};

// A frame for heights: (1, x, y, x^2/2, xy, y^2/2, z) in its coordinates, divided by `size`.
struct HeightFrame {
  RowSurface frame;  // R and c
  double size;       // m
};

struct RowKernel {
  const char* name;
  // The first `count` samples of a block; counts are multiples of lane_count here and below. False where some
  // failed.
  bool (*paper)(const RowSurface&, const SampleBlock&, std::size_t count, RowBlock&);
  bool (*exact)(const RowSurface&, const SampleBlock&, std::size_t count, RowBlock&);
  // Seven rows of heights over a plane, times the root of share / variance along the normal.
  void (*heights)(const HeightFrame&, const SampleBlock&, const double* share, std::size_t count, RowBlock&);
  // Adds the products of up to nine rows; where their number is no multiple of three, rows of 0 follow.
  void (*add)(const double* const* rows, int row_count, std::size_t count, RowSums&);
};

const RowKernel& plain_rows();
const RowKernel* avx2_rows();    // nothing where this machine, or this build, has no AVX2 with FMA
const RowKernel* avx512_rows();  // the same of AVX-512
const RowKernel& fastest_rows();

}  // namespace patchlab
