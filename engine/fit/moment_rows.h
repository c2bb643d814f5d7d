// What the moments of a fit's points take from noise, from the surface and from sampling, many samples at
// once: the sums that engine/fit/moments.h makes its joint covariance from, for whatever vector instructions
// the machine has.
//
// All kernels compile the same lines (moment_rows_kernel.h), under the rules of engine/fit/rows.h.
// engine/fit/moments.cc says the same one sample at a time, in the words of the paper; the tests hold the
// kernels to it.
//
// Derivatives of moments are linear in a point's coordinates, so that every sum is one of products of a few
// rows with monomials. Of surfaces with k3.z = 0 no bound asks for moments with z: what only those need is
// left out.
#pragma once

#include <cstddef>

#include "engine/fit/rows.h"

namespace patchlab {

inline constexpr int monomial_count = 10;  // 1 x y xx xy yy z xz yz zz
inline constexpr int flat_monomials = 6;   // of these, without z

// Rows of a block's samples with weights w, in local axes; groups of three, 0 where they end early.
struct alignas(64) MomentRows {
  double noise[6][block_size];      // w^2 X_q S X_q': xx xy yy xz yz zz
  double weight[3][block_size];     // w, w^2, 0
  double monomial[12][block_size];  // in their order, then 0
  double weighted[9][block_size];   // of foot points: w times each but the first, then 0
  // w X_chart, nine a coordinate of the point (0 at the end); or of plain projections, for each monomial but
  // the first, the row J_monomial S F_q' that meets the fit's own rows.
  double motion[27][block_size];
  double share[block_size];  // F_q S F_q' of plain projections: 1 but where a variance was clamped
};

// A camera as the surface sees it, local axes: where it is (m) and its optical axis.
struct LocalCamera {
  double at[3], axis[3];
};

// Products of three rows with three others, lane by lane.
struct alignas(64) MomentTile {
  double product[9][lane_count] = {};
};

struct MomentKernel {
  const char* name;
  // Method M3: pixel footprints at x on the surface, 0 where `counted` is.
  void (*footprints)(const RowSurface&, const LocalCamera&, const RowBlock&, const double* counted,
                     std::size_t count, double* weight);
  // Rows of foot points (exact rows), and of the samples themselves (paper rows), with weights.
  void (*feet)(const RowSurface&, const SampleBlock&, const RowBlock&, const double* weight,
               std::size_t count, bool with_z, MomentRows&);
  void (*plain)(const RowSurface&, const SampleBlock&, const RowBlock&, const double* weight,
                std::size_t count, bool with_z, MomentRows&);
  // Adds products of each of a_count rows with each of b_count others, both multiples of three, to tiles in
  // that order.
  void (*add)(const double* const* a, int a_count, const double* const* b, int b_count, std::size_t count,
              MomentTile* tiles);
};

const MomentKernel& plain_moment_rows();
const MomentKernel* avx2_moment_rows();    // nothing where this machine, or this build, has no AVX2 with FMA
const MomentKernel* avx512_moment_rows();  // the same of AVX-512
const MomentKernel& fastest_moment_rows();

}  // namespace patchlab
