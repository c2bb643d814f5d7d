// Planes through the windows of an image of inverse depths: the inner loop of grid_normals.h, for whatever
// vector instructions the machine has.
//
// A plane seen by a pinhole camera has an inverse depth that is linear in the pixel, so its normal is a
// linear least-squares fit. All sums are of integers and exact: every kernel gives the same bytes, and no sum
// drifts however far it is carried along. The kernels see plain numbers only. Nothing inline of Eigen or of
// the standard library may be compiled for one machine's instructions, where the linker could take it for
// all.
#pragma once

#include <cstddef>
#include <cstdint>

namespace patchlab {

inline constexpr int window_reach = 5;                 // pixels each way: 11 x 11
inline constexpr std::int32_t most_inverse = 1 << 23;  // largest fixed-point inverse depth, itself left out

// An organised scan: x y z of each pixel, row by row, about whatever origin. A point's depth is axis.q +
// offset, its inverse in fixed point scale / depth; where that is not from 1 to most_inverse, nothing is.
struct GridPoints {
  const float* xyz;
  std::ptrdiff_t width, height;
  float axis[3], offset, scale;
  // Inverse depths that differ by this, or by 1/16 of themselves, are of one surface; fixed point.
  std::int32_t noise;
};

struct WindowCamera {
  float fx, fy, cx, cy;               // px
  float minus_points_from_sensor[9];  // a rotation and -1, row by row
};

struct WindowKernel {
  const char* name;
  // Unit normals, towards the sensor, of the pixels of some rows, written where they belong among those of
  // all pixels, which begin at `normals`; NaN where nothing is or the window tells none. Fitted are those
  // pixels of the window that are of one surface with its middle.
  void (*normals_of_rows)(const GridPoints&, const WindowCamera&, std::ptrdiff_t first, std::ptrdiff_t last,
                          float* normals);
};

const WindowKernel& plain_windows();
const WindowKernel* avx2_windows();  // nothing where this machine, or this build, has no AVX2
const WindowKernel& fastest_windows();

}  // namespace patchlab
