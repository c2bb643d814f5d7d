// The kernels of engine/fit/rows.h; all arithmetic is that of one sample.
#pragma once

#include "engine/fit/rows.h"
#include "engine/fit/rows_surface.h"

namespace patchlab {
namespace {

// B' v, the curvatures' part of a row.
template <Shape shape>
void store_curvatures(const Surface& surface, const Vec& v, RowBlock& block, std::size_t at) {
  const Lanes(*B)[2] = surface.B;
  for (int k = 0; k < 2; ++k) {
    Lanes& row = lanes(block.row[k] + at);
    if (shape == Shape::paraboloid) row = k == 0 ? v.x : v.y;
    if (shape == Shape::flat) row = B[0][k] * v.x + B[1][k] * v.y;
    if (shape == Shape::any) row = B[0][k] * v.x + B[1][k] * v.y + B[2][k] * v.z;
  }
}

// n x a - K p x q, and K p - m n.
template <Shape shape>
Vec rotation(const Surface& surface, const Vec& n, const Vec& a, const Vec& p, const Vec& q) {
  const Lanes Kp_x = surface.k3[0] * p.x, Kp_y = surface.k3[1] * p.y;
  if (shape == Shape::any) {
    return difference(cross(n, a), cross({Kp_x, Kp_y, surface.k3[2] * p.z}, q));
  }
  return {n.y * a.z + a.y - Kp_y * q.z, Kp_x * q.z - a.x - n.x * a.z,
          n.x * a.y - n.y * a.x + (Kp_y * q.x - Kp_x * q.y)};
}
template <Shape shape>
Vec translation(const Surface& surface, const Vec& n, const Vec& p, const Lanes& m) {
  const Lanes* k = surface.k3;
  return {k[0] * p.x - m * n.x, k[1] * p.y - m * n.y, shape == Shape::any ? k[2] * p.z - m * n.z : m};
}

// With g = 2 n, v = 4 n'Sn, m = 1 / sqrt(n'Sn) and p = F m^2 S n, Eq. (36) reads
//   F_k = B' q (m q / 2 - p),  F_w = n x (m q - p) - K p x q,  F_t = K p - m n.
// Three short loops, so that roots and quotients of several samples are under way at once.
template <Shape shape>
bool paper_rows_of(const RowSurface& from, const SampleBlock& samples, std::size_t count, RowBlock& block) {
  alignas(64) double S_n[3][block_size], inverse[block_size];
  const Surface surface(from);
  for (std::size_t at = 0; at < count; at += width) {
    prefetch_next(samples, at);
    const Sample sample = load(samples, at);
    const Vec q = to_local(surface, sample.q), n = half_gradient<shape>(surface, q);
    const Vec Sn = turned_back(surface, product(sample.cov, turned(surface, n)));
    store(block.x, at, q);
    store(S_n, at, Sn);
    lanes(inverse + at) = dot(n, Sn);  // Eq. (34)
  }
  for (std::size_t at = 0; samples.thin && at < count; at += width) {
    const Vec n = half_gradient<shape>(surface, load(block.x, at));
    lanes(inverse + at) = clamped(lanes(inverse + at), trace(load(samples, at).cov), n);
  }
  for (std::size_t at = 0; at < count; at += width) {
    const Lanes s = root(lanes(inverse + at));
    lanes(block.sigma + at) = s + s;
    lanes(inverse + at) = 1.0 / s;
  }
  for (std::size_t at = 0; at < count; at += width) {
    const Vec q = load(block.x, at), n = half_gradient<shape>(surface, q), Sn = load(S_n, at);
    const Lanes m = lanes(inverse + at), half_m = 0.5 * m;
    const Lanes F = implicit(q, n) * half_m;  // Eq. (35)
    const Vec p = scaled(Sn, F * (m * m)), half_mq = scaled(q, half_m), left = difference(half_mq, p);
    const Vec across = {half_mq.x + left.x, half_mq.y + left.y, half_mq.z + left.z};          // m q - p
    store_curvatures<shape>(surface, {q.x * left.x, q.y * left.y, q.z * left.z}, block, at);  // Eq. (36)
    store(block.row + 2, at, rotation<shape>(surface, n, across, p, q));
    store(block.row + 5, at, translation<shape>(surface, n, p, m));
    lanes(block.row[8] + at) = F;
  }
  return true;
}

bool paper_rows(const RowSurface& surface, const SampleBlock& samples, std::size_t count, RowBlock& block) {
  switch (shape_of(surface)) {
    case Shape::paraboloid:
      return paper_rows_of<Shape::paraboloid>(surface, samples, count, block);
    case Shape::flat:
      return paper_rows_of<Shape::flat>(surface, samples, count, block);
    default:
      return paper_rows_of<Shape::any>(surface, samples, count, block);
  }
}

// What stays of a block while its foot points are sought: q - x = l S n(x), l twice the multiplier of
// method M2.
struct alignas(64) FootSearch {
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
Sym local_cov(const Surface& surface, const Sym& C) {
  const Vec(&R)[3] = surface.column;
  const Vec x = turned_back(surface, product(C, R[0])), Cy = product(C, R[1]), Cz = product(C, R[2]);
  return {x.x, x.y, x.z, dot(R[1], Cy), dot(R[2], Cy), dot(R[2], Cz)};
}

template <Shape shape>
void begin_search(const Surface& surface, const SampleBlock& samples, std::size_t count, FootSearch& search) {
  for (std::size_t at = 0; at < count; at += width) {
    prefetch_next(samples, at);
    const Sample sample = load(samples, at);
    const Vec q = to_local(surface, sample.q), n = half_gradient<shape>(surface, q);
    const Sym S = local_cov(surface, sample.cov);
    const Vec Sn = product(S, n);
    const Lanes entries[6] = {S.xx, S.xy, S.xz, S.yy, S.yz, S.zz};
    for (int i = 0; i < 6; ++i) lanes(search.cov[i] + at) = entries[i];
    store(search.q, at, q);
    store(search.Sn, at, Sn);
    lanes(search.l + at) = 0.5 * implicit(q, n) / dot(n, Sn);
  }
}

// (I + l S K)^-1 by cofactors.
template <Shape shape>
struct Inverse {
  Vec row[3];
  Mask positive;  // all eigenvalues of the matrix are

  Inverse(const Surface& surface, const Sym& S, const Lanes& l) {
    const Vec m = {l * surface.k3[0], l * surface.k3[1], l * surface.k3[2]};
    const Lanes a00 = 1.0 + S.xx * m.x, a01 = S.xy * m.y, a02 = S.xz * m.z;
    const Lanes a10 = S.xy * m.x, a11 = 1.0 + S.yy * m.y, a12 = S.yz * m.z;
    const Lanes a20 = S.xz * m.x, a21 = S.yz * m.y, a22 = 1.0 + S.zz * m.z;
    const Lanes c00 = a11 * a22 - a12 * a21, c10 = a12 * a20 - a10 * a22, c20 = a10 * a21 - a11 * a20;
    const Lanes c11 = a00 * a22 - a02 * a20, c22 = a00 * a11 - a01 * a10;
    const Lanes determinant = a00 * c00 + a01 * c10 + a02 * c20, scale = 1.0 / determinant;
    row[0] = scaled({c00, a02 * a21 - a01 * a22, a01 * a12 - a02 * a11}, scale);
    row[1] = scaled({c10, c11, a02 * a10 - a00 * a12}, scale);
    row[2] = scaled({c20, a01 * a20 - a00 * a21, c22}, scale);
    positive = (a00 + a11 + a22 > 0.0) & (c00 + c11 + c22 > 0.0) & (determinant > 0.0);
  }
  Vec times(const Vec& v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
};
// Where k3.z = 0 the last column of the matrix is that of I.
template <Shape shape>
requires(shape != Shape::any) struct Inverse<shape> {
  Lanes i00, i01, i10, i11, a20, a21;
  Mask positive;

  Inverse(const Surface& surface, const Sym& S, const Lanes& l) {
    const Lanes m_x = l * surface.k3[0], m_y = l * surface.k3[1];
    const Lanes a00 = 1.0 + S.xx * m_x, a01 = S.xy * m_y, a10 = S.xy * m_x, a11 = 1.0 + S.yy * m_y;
    const Lanes determinant = a00 * a11 - a01 * a10, scale = 1.0 / determinant;
    i00 = a11 * scale, i01 = a01 * scale, i10 = a10 * scale, i11 = a00 * scale;
    a20 = S.xz * m_x, a21 = S.yz * m_y;
    positive = (a00 + a11 > 0.0) & (determinant > 0.0);
  }
  Vec times(const Vec& v) const {
    const Lanes x = i00 * v.x - i01 * v.y, y = i11 * v.y - i10 * v.x;
    return {x, y, v.z - a20 * x - a21 * y};
  }
};

// One Newton step of every multiplier (engine/patch/foot_point.cc). True where a further one is needed.
template <Shape shape>
bool step_search(const Surface& surface, std::size_t count, FootSearch& search) {
  constexpr double near = 1e-7;  // in standard deviations: one more step squares it
  const Lanes nan = all(__builtin_nan(""));
  Mask far = {};
  for (std::size_t at = 0; at < count; at += width) {
    const Lanes l = lanes(search.l + at);
    const Inverse<shape> inverse(surface, load_cov(search, at), l);
    const Vec Sn = inverse.times(load(search.Sn, at));  // at x
    const Vec x = difference(load(search.q, at), scaled(Sn, l)), n = half_gradient<shape>(surface, x);
    const Lanes f = implicit(x, n), half_slope = dot(n, inverse.times(Sn));
    far |= f * f > 4.0 * near * near * dot(n, Sn);
    lanes(search.l + at) = inverse.positive ? l + 0.5 * f / half_slope : nan;  // gone astray: for good
  }
  return any(far);
}

template <Shape shape>
bool exact_rows_of(const RowSurface& from, const SampleBlock& samples, std::size_t count, RowBlock& block) {
  constexpr int most_steps = 8;
  const Surface surface(from);
  FootSearch search;
  begin_search<shape>(surface, samples, count, search);
  Mask failed = {};
  for (int step = 0; step < most_steps && step_search<shape>(surface, count, search); ++step) continue;
  for (std::size_t at = 0; at < count; at += width) {
    const Lanes l = lanes(search.l + at);
    const Sym S = load_cov(search, at);
    const Inverse<shape> inverse(surface, S, l);
    const Vec Sn = inverse.times(load(search.Sn, at));
    const Vec x = difference(load(search.q, at), scaled(Sn, l)), n = half_gradient<shape>(surface, x);
    const Lanes v = dot(n, Sn), at_least = clamped(v, trace(S), n);
    const Lanes s = root(at_least), m = 1.0 / s, half_m = 0.5 * m;
    store_curvatures<shape>(surface, {x.x * x.x * half_m, x.y * x.y * half_m, x.z * x.z * half_m}, block, at);
    store(block.row + 2, at, scaled(cross(n, x), m));  // Eq. (40)
    store(block.row + 5, at, scaled(n, -m));
    lanes(block.row[8] + at) = v * l * m;
    store(block.x, at, x);
    lanes(block.sigma + at) = s + s;
    const Lanes f = implicit(x, n);
    // A covariance without extent along n is rounding there, and so is whatever multiplier solves it.
    const Mask found = inverse.positive & (v >= at_least) & (f * f <= 1e-24 * s * s + 1e-30 * dot(x, x));
    lanes(block.failed + at) = found ? all(0.0) : all(1.0);
    failed |= lanes(block.failed + at) != 0.0;
  }
  return !any(failed);
}

bool exact_rows(const RowSurface& surface, const SampleBlock& samples, std::size_t count, RowBlock& block) {
  switch (shape_of(surface)) {
    case Shape::paraboloid:
      return exact_rows_of<Shape::paraboloid>(surface, samples, count, block);
    case Shape::flat:
      return exact_rows_of<Shape::flat>(surface, samples, count, block);
    default:
      return exact_rows_of<Shape::any>(surface, samples, count, block);
  }
}

void height_rows(const HeightFrame& heights, const SampleBlock& samples, const double* share,
                 std::size_t count, RowBlock& block) {
  const Surface frame(heights.frame);
  const Vec n = frame.column[2];
  const Lanes inverse = all(1.0 / heights.size);
  for (std::size_t at = 0; at < count; at += width) {
    prefetch_next(samples, at);
    const Sym C = load(samples, at).cov;
    const Lanes v = dot(n, product(C, n));
    lanes(block.sigma + at) = samples.thin ? clamped(v, trace(C), n) : v;
  }
  for (std::size_t at = 0; at < count; at += width) {
    const Vec q = scaled(to_local(frame, load(samples.q, at)), inverse);
    const Lanes s = root(lanes(share + at) / lanes(block.sigma + at)), sx = s * q.x, sy = s * q.y;
    lanes(block.row[0] + at) = s;
    lanes(block.row[1] + at) = sx;
    lanes(block.row[2] + at) = sy;
    lanes(block.row[3] + at) = 0.5 * sx * q.x;
    lanes(block.row[4] + at) = sx * q.y;
    lanes(block.row[5] + at) = 0.5 * sy * q.y;
    lanes(block.row[6] + at) = s * q.z;
  }
}

// Products of three rows with `columns` others, lane by lane, added to sums or where they start; constant
// indices keep the sums in registers.
template <int columns>
void add_products(const double* const* a, const double* const* b, std::size_t count, bool start,
                  double (*sums)[lane_count]) {
  for (std::size_t lane = 0; lane < lane_count; lane += width) {
    Lanes sum[3][columns];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < columns; ++j) sum[i][j] = start ? Lanes{} : lanes(sums[3 * i + j] + lane);
    }
    for (std::size_t at = lane; at < count; at += lane_count) {
      const Lanes a0 = lanes(a[0] + at), a1 = lanes(a[1] + at), a2 = lanes(a[2] + at);
      for (int j = 0; j < columns; ++j) {
        const Lanes b_j = lanes(b[j] + at);
        sum[0][j] += a0 * b_j, sum[1][j] += a1 * b_j, sum[2][j] += a2 * b_j;
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < columns; ++j) lanes(sums[3 * i + j] + lane) = sum[i][j];
    }
  }
}
// Of three rows with themselves: those on and above the diagonal.
void add_squares(const double* const* a, std::size_t count, bool start, double (*sums)[lane_count]) {
  constexpr int used[6] = {0, 1, 2, 4, 5, 8};
  for (std::size_t lane = 0; lane < lane_count; lane += width) {
    Lanes sum[6];
    for (int i = 0; i < 6; ++i) sum[i] = start ? Lanes{} : lanes(sums[used[i]] + lane);
    for (std::size_t at = lane; at < count; at += lane_count) {
      const Lanes a0 = lanes(a[0] + at), a1 = lanes(a[1] + at), a2 = lanes(a[2] + at);
      sum[0] += a0 * a0, sum[1] += a0 * a1, sum[2] += a0 * a2;
      sum[3] += a1 * a1, sum[4] += a1 * a2, sum[5] += a2 * a2;
    }
    for (int i = 0; i < 6; ++i) lanes(sums[used[i]] + lane) = sum[i];
  }
}

void add_rows(const double* const* rows, int row_count, std::size_t count, RowSums& sums) {
  const bool start = sums.empty;
  sums.empty = false;
  int tile = 0;
  for (int i = 0; i < row_count; i += 3) {
    add_squares(rows + i, count, start, sums.tile[tile++]);
    for (int j = i + 3; j < row_count; j += 3) {
      const auto add = j + 1 == row_count ? add_products<1> : add_products<3>;
      add(rows + i, rows + j, count, start, sums.tile[tile++]);
    }
  }
}

}  // namespace
}  // namespace patchlab
