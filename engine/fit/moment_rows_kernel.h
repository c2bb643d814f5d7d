// The kernels of engine/fit/moment_rows.h; all arithmetic is that of one sample.
#pragma once

#include "engine/fit/moment_rows.h"
#include "engine/fit/rows_surface.h"

namespace patchlab {
namespace {

void footprints(const RowSurface& from, const LocalCamera& camera, const RowBlock& rows,
                const double* counted, std::size_t count, double* weight) {
  constexpr double least_cosine = 0.15;
  const Surface surface(from);
  const Vec from_camera = {all(camera.at[0]), all(camera.at[1]), all(camera.at[2])};
  const Vec axis = {all(camera.axis[0]), all(camera.axis[1]), all(camera.axis[2])};
  for (std::size_t at = 0; at < count; at += width) {
    const Vec x = load(rows.x, at), n = half_gradient<Shape::any>(surface, x);
    const Vec ray = difference(x, from_camera);  // not of unit length; depth^2 cos psi = |depth|^3 / |ray|
    const Lanes depth = dot(axis, ray), lengths = root(dot(n, n) * dot(ray, ray)), facing = dot(n, ray);
    const Lanes deep = depth * depth * (depth < 0.0 ? -depth : depth), up = n.z < 0.0 ? -n.z : n.z;
    const Lanes least = least_cosine * lengths, towards = facing < 0.0 ? -facing : facing;
    const Lanes seen = deep * up / (towards < least ? least : towards);
    lanes(weight + at) = lanes(counted + at) > 0.0 ? seen : all(0.0);
  }
}

// R' C R.
inline Sym in_local_axes(const Surface& surface, const Sym& C) {
  const Vec(&R)[3] = surface.column;
  const Vec x = turned_back(surface, product(C, R[0])), Cy = product(C, R[1]), Cz = product(C, R[2]);
  return {x.x, x.y, x.z, dot(R[1], Cy), dot(R[2], Cy), dot(R[2], Cz)};
}

inline void store_sym(const Sym& S, const Lanes& scale, bool with_z, MomentRows& to, std::size_t at) {
  const Lanes entries[6] = {S.xx, S.xy, S.yy, S.xz, S.yz, S.zz};
  for (int i = 0; i < (with_z ? 6 : 3); ++i) lanes(to.noise[i] + at) = scale * entries[i];
}

inline void store_monomials(const Vec& x, const Lanes& w, bool with_z, MomentRows& to, std::size_t at) {
  lanes(to.weight[0] + at) = w;
  lanes(to.weight[1] + at) = w * w;
  lanes(to.weight[2] + at) = all(0.0);
  const Lanes monomials[12] = {all(1.0), x.x,       x.y,       x.x * x.x, x.x * x.y, x.y * x.y,
                               x.z,      x.x * x.z, x.y * x.z, x.z * x.z, all(0.0),  all(0.0)};
  for (int i = 0; i < (with_z ? 12 : flat_monomials); ++i) lanes(to.monomial[i] + at) = monomials[i];
}

inline void store_weighted(const Lanes& w, bool with_z, MomentRows& to, std::size_t at) {
  for (int i = 1; i < (with_z ? monomial_count : flat_monomials); ++i) {
    lanes(to.weighted[i - 1] + at) = w * lanes(to.monomial[i] + at);
  }
  if (!with_z) lanes(to.weighted[flat_monomials - 1] + at) = all(0.0);
}

// Of one coordinate of a foot point, r a row of w X_q: how it moves with (k, w, t). d q = [q]x w - t.
inline void store_motion(const Vec& r, const Lanes& along, const Lanes* f_k, const Vec& q,
                         double (*row)[block_size], std::size_t at) {
  lanes(row[0] + at) = -along * f_k[0];
  lanes(row[1] + at) = -along * f_k[1];
  store(row + 2, at, cross(r, q));
  store(row + 5, at, scaled(r, all(-1.0)));
  lanes(row[8] + at) = all(0.0);
}

// X_q = I - S g g' / v, X_k = -S g f_k / v, and X_q S X_q' = S - S g g' S / v; g = 2 n, v = sigma^2.
void feet_rows(const RowSurface& from, const SampleBlock& samples, const RowBlock& rows, const double* weight,
               std::size_t count, bool with_z, MomentRows& to) {
  const Surface surface(from);
  for (std::size_t at = 0; at < count; at += width) {
    const Sample sample = load(samples, at);
    const Vec x = load(rows.x, at), q = to_local(surface, sample.q),
              n = half_gradient<Shape::any>(surface, x);
    const Sym S = in_local_axes(surface, sample.cov);
    const Lanes w = lanes(weight + at), sigma = lanes(rows.sigma + at), inverse = 2.0 / (sigma * sigma);
    const Vec Sn = product(S, n), along = scaled(Sn, inverse), twice = scaled(along, all(2.0));
    store_sym({S.xx - twice.x * Sn.x, S.xy - twice.x * Sn.y, S.xz - twice.x * Sn.z, S.yy - twice.y * Sn.y,
               S.yz - twice.y * Sn.z, S.zz - twice.z * Sn.z},
              w * w, with_z, to, at);
    store_monomials(x, w, with_z, to, at);
    store_weighted(w, with_z, to, at);
    const Lanes xx = x.x * x.x, yy = x.y * x.y, zz = x.z * x.z;
    const Lanes f_k[2] = {surface.B[0][0] * xx + surface.B[1][0] * yy + surface.B[2][0] * zz,
                          surface.B[0][1] * xx + surface.B[1][1] * yy + surface.B[2][1] * zz};
    const Vec a = scaled(along, w), b = scaled(twice, w);
    store_motion({w - b.x * n.x, -b.x * n.y, -b.x * n.z}, a.x, f_k, q, to.motion, at);
    store_motion({-b.y * n.x, w - b.y * n.y, -b.y * n.z}, a.y, f_k, q, to.motion + 9, at);
    if (with_z) store_motion({-b.z * n.x, -b.z * n.y, w - b.z * n.z}, a.z, f_k, q, to.motion + 18, at);
  }
}

// X_q = I, and w J_monomial S F_q' for what moments and fit share.
void plain_rows_of(const RowSurface& from, const SampleBlock& samples, const RowBlock& rows,
                   const double* weight, std::size_t count, bool with_z, MomentRows& to) {
  const Surface surface(from);
  for (std::size_t at = 0; at < count; at += width) {
    const Vec x = load(rows.x, at), n = half_gradient<Shape::any>(surface, x);
    const Sym S = in_local_axes(surface, load(samples, at).cov);
    const Lanes w = lanes(weight + at), inverse = 2.0 / lanes(rows.sigma + at);
    const Vec Sn = product(S, n), b = scaled(Sn, w * inverse);
    store_sym(S, w * w, with_z, to, at);
    store_monomials(x, w, true, to, at);
    lanes(to.share + at) = inverse * inverse * dot(n, Sn);
    const Lanes shared[9] = {b.x,
                             b.y,
                             2.0 * x.x * b.x,
                             x.y * b.x + x.x * b.y,
                             2.0 * x.y * b.y,
                             b.z,
                             x.z * b.x + x.x * b.z,
                             x.z * b.y + x.y * b.z,
                             2.0 * x.z * b.z};
    for (int i = 0; i < (with_z ? 9 : 5); ++i) lanes(to.motion[i] + at) = shared[i];
    if (!with_z) lanes(to.motion[5] + at) = all(0.0);
  }
}

inline void add_tile(const double* const* a, const double* const* b, std::size_t count, MomentTile& tile) {
  for (std::size_t lane = 0; lane < lane_count; lane += width) {
    Lanes sum[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sum[i][j] = lanes(tile.product[3 * i + j] + lane);
    }
    for (std::size_t at = lane; at < count; at += lane_count) {
      const Lanes b0 = lanes(b[0] + at), b1 = lanes(b[1] + at), b2 = lanes(b[2] + at);
      for (int i = 0; i < 3; ++i) {
        const Lanes a_i = lanes(a[i] + at);
        sum[i][0] += a_i * b0, sum[i][1] += a_i * b1, sum[i][2] += a_i * b2;
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) lanes(tile.product[3 * i + j] + lane) = sum[i][j];
    }
  }
}

void add_outer(const double* const* a, int a_count, const double* const* b, int b_count, std::size_t count,
               MomentTile* tiles) {
  for (int i = 0; i < a_count; i += 3) {
    for (int j = 0; j < b_count; j += 3) add_tile(a + i, b + j, count, *tiles++);
  }
}

}  // namespace
}  // namespace patchlab
