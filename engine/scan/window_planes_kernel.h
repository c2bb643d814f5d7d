// The kernel of engine/scan/window_planes.h. Each window_planes_*.cc compiles it for its own instructions, in
// an unnamed namespace: what is compiled for one machine cannot be linked into what runs on another.
#pragma once

#include "engine/scan/window_sums.h"

namespace patchlab {
namespace {

Floats as_floats(const std::int16_t* p) {
  return __builtin_convertvector(__builtin_convertvector(*reinterpret_cast<const HalfShorts*>(p), Ints),
                                 Floats);
}
Floats as_floats(const std::int32_t* p) { return __builtin_convertvector(ints(p), Floats); }

#ifdef __AVX2__
Floats root(const Floats& v) { return __builtin_ia32_sqrtps256(v); }
#else
Floats root(const Floats& v) {
  Floats roots;
  for (int i = 0; i < int_lanes; ++i) roots[i] = __builtin_sqrtf(v[i]);
  return roots;
}
#endif

// x0 y0 z0 x1 ...
#ifdef __AVX2__
Floats& floats(float* p) { return *reinterpret_cast<Floats*>(p); }
void store_in_turn(const Floats& x, const Floats& y, const Floats& z, float* to) {
  const Floats xy_0 = __builtin_shufflevector(x, y, 0, 8, -1, 1, 9, -1, 2, 10);
  const Floats xy_1 = __builtin_shufflevector(x, y, -1, 3, 11, -1, 4, 12, -1, 5);
  const Floats xy_2 = __builtin_shufflevector(x, y, 13, -1, 6, 14, -1, 7, 15, -1);
  floats(to) = __builtin_shufflevector(xy_0, z, 0, 1, 8, 3, 4, 9, 6, 7);
  floats(to + 8) = __builtin_shufflevector(xy_1, z, 10, 1, 2, 11, 4, 5, 12, 7);
  floats(to + 16) = __builtin_shufflevector(xy_2, z, 0, 13, 2, 3, 14, 5, 6, 15);
}
#else
void store_in_turn(const Floats& x, const Floats& y, const Floats& z, float* to) {
  for (int i = 0; i < int_lanes; ++i) {
    to[3 * i] = x[i];
    to[3 * i + 1] = y[i];
    to[3 * i + 2] = z[i];
  }
}
#endif

// d = a + b k + c j by least squares, each times what makes it free of divisions.
struct Plane {
  Floats a, b, c;
  Ints told;
};

Plane plane_of_full(const WindowSums& sums, std::ptrdiff_t i) {
  constexpr float means = static_cast<float>(square_sum) / window_size;
  const Floats d = as_floats(sums.d + i);
  return {means * d, as_floats(sums.kd + i), as_floats(sums.jd + i), d > 0.0F};
}

Plane plane_of(const WindowSums& sums, std::ptrdiff_t i) {
  constexpr float small = 0x1p-20F;  // keeps what follows within its range
  const Floats n = as_floats(sums.n + i), k = as_floats(sums.k + i), j = as_floats(sums.j + i);
  const Floats d = small * as_floats(sums.d + i), small_n = small * n;
  const Floats kk = n * as_floats(sums.kk + i) - k * k, kj = n * as_floats(sums.kj + i) - k * j;
  const Floats jj = n * as_floats(sums.jj + i) - j * j;
  const Floats kd = small_n * as_floats(sums.kd + i) - k * d, jd = small_n * as_floats(sums.jd + i) - j * d;
  const Floats determinant = kk * jj - kj * kj, b = kd * jj - jd * kj, c = jd * kk - kd * kj;
  return {d * determinant - b * k - c * j, n * b, n * c, determinant > 0.0F};
}

// Where m.(s, t, 1) = d for the rays (s, t, 1) of a plane, m = (b fx, c fy, a - b (x - cx) - c (y - cy)).
void solve(const WindowSums& sums, const WindowCamera camera, std::ptrdiff_t x0, std::ptrdiff_t y0,
           const std::int32_t* middle, float* normals) {
  const float* const R = camera.minus_points_from_sensor;
  const float left = static_cast<float>(x0) - camera.cx, down = static_cast<float>(y0) - camera.cy;
  Floats column, nothing;
  for (int i = 0; i < int_lanes; ++i) {
    column[i] = static_cast<float>(i) + left;
    nothing[i] = __builtin_nanf("");
  }
  for (std::ptrdiff_t i = 0; i < strip; i += int_lanes, column += static_cast<float>(int_lanes)) {
    const Plane plane = sums.full[i / block] ? plane_of_full(sums, i) : plane_of(sums, i);
    const Floats x = camera.fx * plane.b, y = camera.fy * plane.c;
    const Floats z = plane.a - plane.b * column - plane.c * down;
    const Ints told = plane.told & (ints(middle + side + i) != 0);
    const Floats scale = told ? 1.0F / root(x * x + y * y + z * z) : nothing;
    store_in_turn(scale * (R[0] * x + R[1] * y + R[2] * z), scale * (R[3] * x + R[4] * y + R[5] * z),
                  scale * (R[6] * x + R[7] * y + R[8] * z), normals + 3 * i);
  }
}

// Calls visit(i) where flags[i] is not 0; few are.
template <class Visit>
void for_flags(const std::uint16_t* flags, Visit visit) {
  for (std::ptrdiff_t i = 0; i < strip; i += 4) {
    std::uint64_t four;
    __builtin_memcpy(&four, flags + i, sizeof four);
    for (std::ptrdiff_t lane = i; four != 0 && lane < i + 4; ++lane) {
      if (flags[lane] != 0) visit(lane);
    }
  }
}

void normals_of_strip(const Rows& rows, const ColumnSums& columns, const WindowCamera& camera,
                      std::ptrdiff_t x, std::ptrdiff_t y, std::int32_t noise, float* normals) {
  ColumnRanges ranges;
  WindowSums sums;
  std::uint16_t mixed[strip];
  find_ranges(rows, y, ranges);
  find_mixed(rows.coarse[Rows::slot(y)], ranges, noise, mixed);
  add_columns(columns, sums);
  for_flags(mixed, [&](std::ptrdiff_t i) { add_like(rows, y, noise, i, sums); });
  solve(sums, camera, x, y, rows.fine[Rows::slot(y)], normals);
}

void normals_of_rows(const GridPoints& points, const WindowCamera& camera, std::ptrdiff_t first,
                     std::ptrdiff_t last, float* normals) {
  float some[3 * strip];
  for (std::ptrdiff_t x = 0; x < points.width; x += strip) {
    const std::ptrdiff_t rest = points.width - x, count = rest < strip ? rest : strip;
    Rows rows;
    ColumnSums columns = {};
    for (std::ptrdiff_t y = first - 2 * reach; y < last; ++y) {
      read_row(points, x, y + reach, rows);
      advance(rows, y, columns);
      if (y < first) continue;
      float* const out = normals + 3 * (y * points.width + x);
      normals_of_strip(rows, columns, camera, x, y, points.noise, count == strip ? out : some);
      if (count < strip) __builtin_memcpy(out, some, sizeof(float) * 3 * static_cast<std::size_t>(count));
    }
  }
}

}  // namespace
}  // namespace patchlab
