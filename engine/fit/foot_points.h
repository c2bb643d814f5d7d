// Step 5: the points of a fit on its surface, and what each of them weighs there.
#pragma once

#include <optional>
#include <vector>

#include "engine/fit/fit_surface.h"
#include "engine/fit/moment_rows.h"
#include "engine/fit/sample_rows.h"

namespace patchlab {

// Foot points and pixel-footprint weights of all samples on a fitted surface (method M3); or the measured
// points themselves with equal weights, Eq. (16).
struct FootPoints {
  std::vector<Vector3d> x;     // local axes, m
  std::vector<double> weight;  // sum 1; zero for points of robust weight zero
  std::vector<double> F;       // residuals in standard deviations: exact ones of foot points
};
FootPoints foot_points(const Samples& samples, const SurfaceFit& fit);

// Method M3 for one sample, not yet of sum 1: the area that its pixel sees of the patch, on the xy plane of
// the surface. 1 without a camera, 0 for robust weight zero.
double footprint(const Samples& samples, const SurfaceState& state, std::size_t i, const Residual& r);

// The same for all samples of a block.
class Footprints {
 public:
  Footprints(const Samples& samples, const SampleRows& rows, const SurfaceState& state,
             const MomentKernel& kernel = fastest_moment_rows());
  // `weight` holds block_size numbers: 0 beyond the samples.
  void weigh(std::size_t block, const RowBlock& rows, double* weight) const;
  // 1 for those that count, 0 for the others.
  void count(std::size_t block, double* counted) const;

 private:
  const Samples& samples_;
  const SampleRows& rows_;
  const SurfaceState& state_;
  const MomentKernel& kernel_;
  LocalCamera camera_{};
};

// Rows beyond the samples of a block: a foot point and a variance that harm no sum, whatever was there.
void settle_padding(std::size_t count, RowBlock& rows);

inline double sum_of(const MomentTile& tile, int product) {
  const double* lane = tile.product[product];
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

// Room for all samples, and a block of them.
FootPoints room_for_feet(const Samples& samples);
void put_feet(const RowBlock& rows, const double* weight, std::size_t block, std::size_t count,
              FootPoints& feet);
void scale_weights(double by, FootPoints& feet);

}  // namespace patchlab
