// Residuals and their rows F_p, Eqs. (34)-(36), of many samples at once: the innermost loop of every fit, for
// whatever vector instructions the machine has.
//
// Every kernel does the same additions and multiplications in the same order, four samples side by side, and
// none fuses them: a fit gives the same bytes with each. engine/fit/distance.h says the same one sample at a
// time, in the words of the paper; the tests hold the kernels to it.
//
// The kernels see plain numbers only. Nothing inline of Eigen or of the standard library may be compiled for
// one machine's instructions, where the linker could take it for all.
#pragma once

#include <cstddef>

namespace patchlab {

inline constexpr std::size_t lane_count = 4;
inline constexpr std::size_t block_size = 64;  // samples whose rows stay in the first-level cache
inline constexpr int row_count = 9;            // F_p in the chart's eight coordinates, then F

// The surface in the order of the chart: q_local = R' (q - c), k3 = B k.
struct RowSurface {
  double R[3][3];
  double c[3];
  double k3[3];
  double B[3][2];
};

// Samples side by side, in the frame of the points.
struct alignas(32) SampleBlock {
  double q[3][block_size];    // m
  double cov[6][block_size];  // xx xy xz yy yz zz, m^2
};

struct alignas(32) RowBlock {
  double row[row_count][block_size];
  double x[3][block_size];   // foot points (exact) or the samples themselves (paper), local
  double sigma[block_size];  // sqrt(g' S g): F_q = g / sigma
  double
      failed[block_size];  // of exact rows: not 0 where no foot point was found; the rest says nothing there
};

// Sums of products of rows, three by three: tile (I, J) of up to three groups of three rows, lane by lane.
struct alignas(32) RowSums {
  double tile[6][9][lane_count] = {};
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
  // Rows of heights over a plane, times the root of share / variance along the normal; two of 0.
  void (*heights)(const HeightFrame&, const SampleBlock&, const double* share, std::size_t count, RowBlock&);
  // Adds the products of 3 * groups rows, groups <= 3.
  void (*add)(const double* const* rows, int groups, std::size_t count, RowSums&);
};

const RowKernel& plain_rows();
const RowKernel* avx2_rows();  // nothing where this machine, or this build, has no AVX2
const RowKernel& fastest_rows();

}  // namespace patchlab
