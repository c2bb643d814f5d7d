// The surface of a fit in the arithmetic of the kernels: what all samples share, and one sample before it.
#pragma once

#include "engine/fit/rows.h"
#include "engine/fit/rows_lanes.h"

namespace patchlab {
namespace {

struct Sample {
  Vec q;
  Sym cov;
};
inline Sample load(const SampleBlock& block, std::size_t at) {
  const auto cov = [&](int i) { return lanes(block.cov[i] + at); };
  return {load(block.q, at), {cov(0), cov(1), cov(2), cov(3), cov(4), cov(5)}};
}

// What all samples share, in every lane.
struct Surface {
  Vec column[3];  // of R
  Vec c;
  Lanes k3[3], B[3][2];

  explicit Surface(const RowSurface& from) : c{all(from.c[0]), all(from.c[1]), all(from.c[2])} {
    for (int i = 0; i < 3; ++i) {
      column[i] = {all(from.R[0][i]), all(from.R[1][i]), all(from.R[2][i])};
      k3[i] = all(from.k3[i]);
      for (int j = 0; j < 2; ++j) B[i][j] = all(from.B[i][j]);
    }
  }
};

// What is known of a surface while its kernel is compiled: of planes and paraboloids that they do not bend
// along z, k3.z = 0; of the paraboloid of eight parameters that B is I there.
enum class Shape { paraboloid, flat, any };
inline Shape shape_of(const RowSurface& surface) {
  const double(*B)[2] = surface.B;
  if (surface.k3[2] != 0.0 || B[2][0] != 0.0 || B[2][1] != 0.0) return Shape::any;
  const bool unit = B[0][0] == 1.0 && B[0][1] == 0.0 && B[1][0] == 0.0 && B[1][1] == 1.0;
  return unit ? Shape::paraboloid : Shape::flat;
}

inline Vec turned(const Surface& surface, const Vec& v) {  // R v
  const Vec(&R)[3] = surface.column;
  return {R[0].x * v.x + R[1].x * v.y + R[2].x * v.z, R[0].y * v.x + R[1].y * v.y + R[2].y * v.z,
          R[0].z * v.x + R[1].z * v.y + R[2].z * v.z};
}
inline Vec turned_back(const Surface& surface, const Vec& v) {  // R' v
  return {dot(surface.column[0], v), dot(surface.column[1], v), dot(surface.column[2], v)};
}
inline Vec to_local(const Surface& surface, const Vec& q) {  // Eq. (4)
  return turned_back(surface, difference(q, surface.c));
}
// n = K q - z: half the gradient, Eq. (39), so that no factor of 2 has to be multiplied out.
template <Shape shape>
inline Vec half_gradient(const Surface& surface, const Vec& q) {
  const Lanes* k = surface.k3;
  return {k[0] * q.x, k[1] * q.y, shape == Shape::any ? k[2] * q.z - 1.0 : all(-1.0)};
}
inline Lanes implicit(const Vec& q, const Vec& n) { return dot(q, n) - q.z; }  // Eq. (37)
// Footnote 10, as in engine/fit/distance.cc: n' S n.
inline Lanes clamped(const Lanes& v, const Lanes& trace_of_cov, const Vec& n) {
  const Lanes least = 1e-12 * trace_of_cov * dot(n, n) + __DBL_MIN__;
  return v < least ? least : v;
}

}  // namespace
}  // namespace patchlab
