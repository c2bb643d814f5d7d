// The kernels of engine/fit/rows.h. Each rows_*.cc compiles them for its own instructions, in an unnamed
// namespace: what is compiled for one machine cannot be linked into what runs on another.
#pragma once

#include "engine/fit/rows.h"

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace patchlab {
namespace {

// Numbers of as many samples as one instruction takes; all arithmetic below is that of one.
#ifdef __AVX__
using Lanes = double __attribute__((vector_size(8 * lane_count), may_alias));
constexpr std::size_t width = lane_count;
#else
using Lanes = double;
constexpr std::size_t width = 1;
#endif
using Mask = decltype(Lanes{} < Lanes{});

struct Vec {
  Lanes x, y, z;
};
struct Sym {
  Lanes xx, xy, xz, yy, yz, zz;
};

Lanes dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Lanes dot(const double* a, const Vec& b) { return a[0] * b.x + a[1] * b.y + a[2] * b.z; }
Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec scaled(const Vec& a, const Lanes& s) { return {a.x * s, a.y * s, a.z * s}; }
Vec difference(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec product(const Sym& S, const Vec& v) {
  return {S.xx * v.x + S.xy * v.y + S.xz * v.z, S.xy * v.x + S.yy * v.y + S.yz * v.z,
          S.xz * v.x + S.yz * v.y + S.zz * v.z};
}
Vec turned(const double (*R)[3], const Vec& v) { return {dot(R[0], v), dot(R[1], v), dot(R[2], v)}; }
Vec turned_back(const double (*R)[3], const Vec& v) {  // R' v
  return {R[0][0] * v.x + R[1][0] * v.y + R[2][0] * v.z, R[0][1] * v.x + R[1][1] * v.y + R[2][1] * v.z,
          R[0][2] * v.x + R[1][2] * v.y + R[2][2] * v.z};
}
Lanes trace(const Sym& S) { return S.xx + S.yy + S.zz; }

#ifdef __AVX__
Lanes root(const Lanes& v) { return _mm256_sqrt_pd(v); }
bool any(const Mask& mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }
#else
Lanes root(Lanes v) { return __builtin_sqrt(v); }
bool any(Mask mask) { return mask; }
#endif

Lanes& lanes(double* numbers) { return *reinterpret_cast<Lanes*>(numbers); }
const Lanes& lanes(const double* numbers) { return *reinterpret_cast<const Lanes*>(numbers); }
void store(double (*to)[block_size], std::size_t at, const Vec& v) {
  lanes(to[0] + at) = v.x;
  lanes(to[1] + at) = v.y;
  lanes(to[2] + at) = v.z;
}
Vec load(const double (*from)[block_size], std::size_t at) {
  return {lanes(from[0] + at), lanes(from[1] + at), lanes(from[2] + at)};
}

struct Sample {
  Vec q;
  Sym cov;
};
Sample load(const SampleBlock& block, std::size_t at) {
  const auto cov = [&](int i) { return lanes(block.cov[i] + at); };
  return {load(block.q, at), {cov(0), cov(1), cov(2), cov(3), cov(4), cov(5)}};
}

Vec to_local(const RowSurface& surface, const Vec& q) {  // Eq. (4)
  return turned_back(surface.R, {q.x - surface.c[0], q.y - surface.c[1], q.z - surface.c[2]});
}
Vec times_k(const RowSurface& surface, const Vec& v) {  // K v
  return {surface.k3[0] * v.x, surface.k3[1] * v.y, surface.k3[2] * v.z};
}
// n = K q - z: half the gradient, Eq. (39), so that no factor of 2 has to be multiplied out.
Vec half_gradient(const RowSurface& surface, const Vec& q) {
  const Vec Kq = times_k(surface, q);
  return {Kq.x, Kq.y, Kq.z - 1.0};
}
Lanes implicit(const Vec& q, const Vec& n) { return dot(q, n) - q.z; }  // Eq. (37)
// Footnote 10, as in engine/fit/distance.cc: n' S n.
Lanes clamped(const Lanes& v, const Lanes& trace_of_cov, const Vec& n) {
  const Lanes least = 1e-12 * trace_of_cov * dot(n, n) + __DBL_MIN__;
  return v < least ? least : v;
}

// B' v, the curvatures' part of a row.
void store_curvatures(const RowSurface& surface, const Vec& v, RowBlock& block, std::size_t at) {
  for (int k = 0; k < 2; ++k) {
    lanes(block.row[k] + at) = surface.B[0][k] * v.x + surface.B[1][k] * v.y + surface.B[2][k] * v.z;
  }
}

// With g = 2 n, v = 4 n'Sn, m = 1 / sqrt(n'Sn) and p = F m^2 S n, Eq. (36) reads
//   F_k = B' q (m q / 2 - p),  F_w = n x (m q - p) - K p x q,  F_t = K p - m n.
// Three short loops, so that roots and quotients of several samples are under way at once.
bool paper_rows(const RowSurface& surface, const SampleBlock& samples, std::size_t count, RowBlock& block) {
  alignas(32) double S_n[3][block_size], inverse[block_size];
  for (std::size_t at = 0; at < count; at += width) {
    const Sample sample = load(samples, at);
    const Vec q = to_local(surface, sample.q), n = half_gradient(surface, q);
    const Vec Sn = turned_back(surface.R, product(sample.cov, turned(surface.R, n)));
    store(block.x, at, q);
    store(S_n, at, Sn);
    lanes(inverse + at) = clamped(dot(n, Sn), trace(sample.cov), n);  // Eq. (34)
  }
  for (std::size_t at = 0; at < count; at += width) {
    const Lanes s = root(lanes(inverse + at));
    lanes(block.sigma + at) = s + s;
    lanes(inverse + at) = 1.0 / s;
  }
  for (std::size_t at = 0; at < count; at += width) {
    const Vec q = load(block.x, at), n = half_gradient(surface, q), Sn = load(S_n, at);
    const Lanes m = lanes(inverse + at), half_m = 0.5 * m;
    const Lanes F = implicit(q, n) * half_m;  // Eq. (35)
    const Vec p = scaled(Sn, F * (m * m)), Kp = times_k(surface, p);
    const Vec half_mq = scaled(q, half_m), left = difference(half_mq, p);
    const Vec across = {half_mq.x + left.x, half_mq.y + left.y, half_mq.z + left.z};   // m q - p
    store_curvatures(surface, {q.x * left.x, q.y * left.y, q.z * left.z}, block, at);  // Eq. (36)
    store(block.row + 2, at, difference(cross(n, across), cross(Kp, q)));
    store(block.row + 5, at, difference(Kp, scaled(n, m)));
    lanes(block.row[8] + at) = F;
  }
  return true;
}

// What stays of a block while its foot points are sought: q - x = l S n(x), l twice the multiplier of
// method M2.
struct alignas(32) FootSearch {
  double q[3][block_size];
  double cov[6][block_size];
  double Sn[3][block_size];  // at q
  double l[block_size];
};

Sym load_cov(const FootSearch& search, std::size_t at) {
  const auto cov = [&](int i) { return lanes(search.cov[i] + at); };
  return {cov(0), cov(1), cov(2), cov(3), cov(4), cov(5)};
}

// R' C R.
Sym local_cov(const RowSurface& surface, const Sym& C) {
  const double(*R)[3] = surface.R;
  Vec column[3];
  for (int j = 0; j < 3; ++j) {
    const Vec CR = {C.xx * R[0][j] + C.xy * R[1][j] + C.xz * R[2][j],
                    C.xy * R[0][j] + C.yy * R[1][j] + C.yz * R[2][j],
                    C.xz * R[0][j] + C.yz * R[1][j] + C.zz * R[2][j]};
    column[j] = turned_back(R, CR);
  }
  return {column[0].x, column[1].x, column[2].x, column[1].y, column[2].y, column[2].z};
}

void begin_search(const RowSurface& surface, const SampleBlock& samples, std::size_t count,
                  FootSearch& search) {
  for (std::size_t at = 0; at < count; at += width) {
    const Sample sample = load(samples, at);
    const Vec q = to_local(surface, sample.q), n = half_gradient(surface, q);
    const Sym S = local_cov(surface, sample.cov);
    const Vec Sn = product(S, n);
    const Lanes entries[6] = {S.xx, S.xy, S.xz, S.yy, S.yz, S.zz};
    for (int i = 0; i < 6; ++i) lanes(search.cov[i] + at) = entries[i];
    store(search.q, at, q);
    store(search.Sn, at, Sn);
    lanes(search.l + at) = implicit(q, n) / (2.0 * dot(n, Sn));
  }
}

// (I + l S K)^-1 by cofactors. Where the surface is flat along z, as planes and paraboloids are (k3.z = 0),
// the matrix and its inverse have the last column of I.
template <bool flat>
struct Inverse {
  Vec row[3];
  Mask positive;  // all eigenvalues of the matrix are
};

template <bool flat>
Inverse<flat> invert(const RowSurface& surface, const Sym& S, const Lanes& l);

template <>
Inverse<false> invert<false>(const RowSurface& surface, const Sym& S, const Lanes& l) {
  const Vec m = {l * surface.k3[0], l * surface.k3[1], l * surface.k3[2]};
  const Lanes a00 = 1.0 + S.xx * m.x, a01 = S.xy * m.y, a02 = S.xz * m.z;
  const Lanes a10 = S.xy * m.x, a11 = 1.0 + S.yy * m.y, a12 = S.yz * m.z;
  const Lanes a20 = S.xz * m.x, a21 = S.yz * m.y, a22 = 1.0 + S.zz * m.z;
  const Lanes c00 = a11 * a22 - a12 * a21, c10 = a12 * a20 - a10 * a22, c20 = a10 * a21 - a11 * a20;
  const Lanes c11 = a00 * a22 - a02 * a20, c22 = a00 * a11 - a01 * a10;
  const Lanes determinant = a00 * c00 + a01 * c10 + a02 * c20, scale = 1.0 / determinant;
  Inverse<false> inverse;
  inverse.row[0] = scaled({c00, a02 * a21 - a01 * a22, a01 * a12 - a02 * a11}, scale);
  inverse.row[1] = scaled({c10, c11, a02 * a10 - a00 * a12}, scale);
  inverse.row[2] = scaled({c20, a01 * a20 - a00 * a21, c22}, scale);
  inverse.positive = (a00 + a11 + a22 > 0.0) & (c00 + c11 + c22 > 0.0) & (determinant > 0.0);
  return inverse;
}
Vec product(const Inverse<false>& inverse, const Vec& v) {
  return {dot(inverse.row[0], v), dot(inverse.row[1], v), dot(inverse.row[2], v)};
}

template <>
Inverse<true> invert<true>(const RowSurface& surface, const Sym& S, const Lanes& l) {
  const Lanes m_x = l * surface.k3[0], m_y = l * surface.k3[1];
  const Lanes a00 = 1.0 + S.xx * m_x, a01 = S.xy * m_y, a10 = S.xy * m_x, a11 = 1.0 + S.yy * m_y;
  const Lanes a20 = S.xz * m_x, a21 = S.yz * m_y;
  const Lanes determinant = a00 * a11 - a01 * a10, scale = 1.0 / determinant, zero = {};
  const Lanes i00 = a11 * scale, i01 = -a01 * scale, i10 = -a10 * scale, i11 = a00 * scale;
  Inverse<true> inverse;
  inverse.row[0] = {i00, i01, zero};
  inverse.row[1] = {i10, i11, zero};
  inverse.row[2] = {-(a20 * i00 + a21 * i10), -(a20 * i01 + a21 * i11), zero + 1.0};
  inverse.positive = (a00 + a11 > 0.0) & (determinant > 0.0);
  return inverse;
}
Vec product(const Inverse<true>& inverse, const Vec& v) {
  const Vec(&row)[3] = inverse.row;
  return {row[0].x * v.x + row[0].y * v.y, row[1].x * v.x + row[1].y * v.y,
          row[2].x * v.x + row[2].y * v.y + v.z};
}

// One Newton step of every multiplier (engine/patch/foot_point.cc). True where a further one is needed.
template <bool flat>
bool step_search(const RowSurface& surface, std::size_t count, FootSearch& search) {
  constexpr double near = 1e-7;  // in standard deviations: one more step squares it
  const Lanes nan = Lanes{} + __builtin_nan("");
  Mask far = {};
  for (std::size_t at = 0; at < count; at += width) {
    const Lanes l = lanes(search.l + at);
    const Inverse<flat> inverse = invert<flat>(surface, load_cov(search, at), l);
    const Vec Sn = product(inverse, load(search.Sn, at));  // at x
    const Vec x = difference(load(search.q, at), scaled(Sn, l)), n = half_gradient(surface, x);
    const Lanes f = implicit(x, n), half_slope = dot(n, product(inverse, Sn));
    far |= f * f > 4.0 * near * near * dot(n, Sn);
    lanes(search.l + at) = inverse.positive ? l + 0.5 * f / half_slope : nan;  // gone astray: for good
  }
  return any(far);
}

template <bool flat>
bool exact_rows_of(const RowSurface& surface, const SampleBlock& samples, std::size_t count,
                   RowBlock& block) {
  constexpr int most_steps = 8;
  FootSearch search;
  begin_search(surface, samples, count, search);
  Mask failed = {};
  for (int step = 0; step < most_steps && step_search<flat>(surface, count, search); ++step) continue;
  for (std::size_t at = 0; at < count; at += width) {
    const Lanes l = lanes(search.l + at);
    const Sym S = load_cov(search, at);
    const Inverse<flat> inverse = invert<flat>(surface, S, l);
    const Vec Sn = product(inverse, load(search.Sn, at));
    const Vec x = difference(load(search.q, at), scaled(Sn, l)), n = half_gradient(surface, x);
    const Lanes s = root(clamped(dot(n, Sn), trace(S), n)), m = 1.0 / s, half_m = 0.5 * m;
    store_curvatures(surface, {x.x * x.x * half_m, x.y * x.y * half_m, x.z * x.z * half_m}, block, at);
    store(block.row + 2, at, scaled(cross(n, x), m));  // Eq. (40)
    store(block.row + 5, at, scaled(n, -m));
    lanes(block.row[8] + at) = dot(n, Sn) * l * m;
    store(block.x, at, x);
    lanes(block.sigma + at) = s + s;
    const Lanes f = implicit(x, n), zero = {}, one = zero + 1.0;
    const Mask found = inverse.positive & (f * f <= 1e-24 * s * s + 1e-30 * dot(x, x));
    lanes(block.failed + at) = found ? zero : one;
    failed |= lanes(block.failed + at) != 0.0;
  }
  return !any(failed);
}

bool exact_rows(const RowSurface& surface, const SampleBlock& samples, std::size_t count, RowBlock& block) {
  const bool flat = surface.k3[2] == 0.0;
  return flat ? exact_rows_of<true>(surface, samples, count, block)
              : exact_rows_of<false>(surface, samples, count, block);
}

void height_rows(const HeightFrame& heights, const SampleBlock& samples, const double* share,
                 std::size_t count, RowBlock& block) {
  const RowSurface& frame = heights.frame;
  const Lanes zero = {};
  const Vec n = {zero + frame.R[0][2], zero + frame.R[1][2], zero + frame.R[2][2]};
  const double inverse = 1.0 / heights.size;
  for (std::size_t at = 0; at < count; at += width) {
    const Sample sample = load(samples, at);
    const Vec q = scaled(to_local(frame, sample.q), zero + inverse);
    const Lanes v = clamped(dot(n, product(sample.cov, n)), trace(sample.cov), n);
    const Lanes s = root(lanes(share + at) / v), half_sx = 0.5 * s * q.x;
    lanes(block.row[0] + at) = s;
    lanes(block.row[1] + at) = s * q.x;
    lanes(block.row[2] + at) = s * q.y;
    lanes(block.row[3] + at) = half_sx * q.x;
    lanes(block.row[4] + at) = s * q.x * q.y;
    lanes(block.row[5] + at) = 0.5 * s * q.y * q.y;
    lanes(block.row[6] + at) = s * q.z;
    lanes(block.row[7] + at) = lanes(block.row[8] + at) = zero;
  }
}

// Products of three rows with three others, lane by lane; constant indices keep the sums in registers.
void add_products(const double* const* a, const double* const* b, std::size_t count,
                  double (*sums)[lane_count]) {
  for (std::size_t lane = 0; lane < lane_count; lane += width) {
    Lanes sum[9];
    for (int i = 0; i < 9; ++i) sum[i] = lanes(sums[i] + lane);
    for (std::size_t at = lane; at < count; at += lane_count) {
      const Lanes a0 = lanes(a[0] + at), a1 = lanes(a[1] + at), a2 = lanes(a[2] + at);
      const Lanes b0 = lanes(b[0] + at), b1 = lanes(b[1] + at), b2 = lanes(b[2] + at);
      sum[0] += a0 * b0, sum[1] += a0 * b1, sum[2] += a0 * b2;
      sum[3] += a1 * b0, sum[4] += a1 * b1, sum[5] += a1 * b2;
      sum[6] += a2 * b0, sum[7] += a2 * b1, sum[8] += a2 * b2;
    }
    for (int i = 0; i < 9; ++i) lanes(sums[i] + lane) = sum[i];
  }
}
// Of three rows with themselves: those on and above the diagonal.
void add_squares(const double* const* a, std::size_t count, double (*sums)[lane_count]) {
  constexpr int used[6] = {0, 1, 2, 4, 5, 8};
  for (std::size_t lane = 0; lane < lane_count; lane += width) {
    Lanes sum[6];
    for (int i = 0; i < 6; ++i) sum[i] = lanes(sums[used[i]] + lane);
    for (std::size_t at = lane; at < count; at += lane_count) {
      const Lanes a0 = lanes(a[0] + at), a1 = lanes(a[1] + at), a2 = lanes(a[2] + at);
      sum[0] += a0 * a0, sum[1] += a0 * a1, sum[2] += a0 * a2;
      sum[3] += a1 * a1, sum[4] += a1 * a2, sum[5] += a2 * a2;
    }
    for (int i = 0; i < 6; ++i) lanes(sums[used[i]] + lane) = sum[i];
  }
}

void add_rows(const double* const* rows, int groups, std::size_t count, RowSums& sums) {
  int tile = 0;
  for (int i = 0; i < groups; ++i) {
    add_squares(rows + 3 * i, count, sums.tile[tile++]);
    for (int j = i + 1; j < groups; ++j) add_products(rows + 3 * i, rows + 3 * j, count, sums.tile[tile++]);
  }
}

}  // namespace
}  // namespace patchlab
