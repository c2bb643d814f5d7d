// The sums over windows of engine/scan/window_planes.h, for whatever instructions the source is compiled for.
#pragma once

#include "engine/scan/window_planes.h"

namespace patchlab {
namespace {

#ifdef __AVX2__
constexpr std::size_t vector_bytes = 32;
#else
constexpr std::size_t vector_bytes = 16;
#endif
using Shorts = std::int16_t __attribute__((vector_size(vector_bytes), aligned(2), may_alias));
using Words = std::uint16_t __attribute__((vector_size(vector_bytes), aligned(2), may_alias));
using Ints = std::int32_t __attribute__((vector_size(vector_bytes), aligned(4), may_alias));
using Floats = float __attribute__((vector_size(vector_bytes), aligned(4), may_alias));
using HalfShorts = std::int16_t __attribute__((vector_size(vector_bytes / 2), aligned(2), may_alias));
constexpr std::ptrdiff_t short_lanes = vector_bytes / 2, int_lanes = vector_bytes / 4;

constexpr int reach = window_reach, coarse_shift = 7, surface_shift = 4;
constexpr std::ptrdiff_t strip =
    160;  // pixels of a row at a time: all that is kept stays in the first-level cache
constexpr std::ptrdiff_t block = 16;  // pixels that are treated as full windows, or not, together
constexpr std::ptrdiff_t side = 8;    // pixels beside the strip that are looked at
constexpr std::ptrdiff_t wide = strip + 2 * side;
static_assert(reach <= side && side <= block && strip % block == 0 && wide % block == 0 &&
              block % short_lanes == 0);
constexpr int window_side = 2 * reach + 1, window_size = window_side * window_side;
constexpr int square_sum = window_size * reach * (reach + 1) / 3;  // of the columns of a full window

// Fixed-point inverse depths of a strip of the newest rows, 0 where nothing is.
struct Rows {
  static constexpr std::ptrdiff_t kept = 16;
  static_assert(kept > 2 * reach + 1);
  std::int32_t fine[kept][wide + short_lanes] = {};  // readable beyond the last by a vector
  std::uint16_t coarse[kept][wide] = {};  // without the last bits, but 1 at least where something is

  static std::ptrdiff_t slot(std::ptrdiff_t y) { return y & (kept - 1); }
};

// With w = 1 where a pixel is and d its value: sums over the rows of a window, of each column; j is the row
// from the middle one.
struct ColumnSums {
  std::int16_t w[wide], jw[wide], jjw[wide];
  std::int32_t d[wide], jd[wide];
};

// Sums over windows, k the column from the middle.
struct WindowSums {
  std::int16_t n[strip], k[strip], j[strip], kk[strip], kj[strip], jj[strip];
  std::int32_t d[strip], kd[strip], jd[strip];
  bool full[strip / block];  // all windows of a block are: of n to jj nothing is said
};

const Shorts& shorts(const std::int16_t* p) { return *reinterpret_cast<const Shorts*>(p); }
Shorts& shorts(std::int16_t* p) { return *reinterpret_cast<Shorts*>(p); }
const Words& words(const std::uint16_t* p) { return *reinterpret_cast<const Words*>(p); }
Words& words(std::uint16_t* p) { return *reinterpret_cast<Words*>(p); }
const Ints& ints(const std::int32_t* p) { return *reinterpret_cast<const Ints*>(p); }
Ints& ints(std::int32_t* p) { return *reinterpret_cast<Ints*>(p); }

Words least(const Words& a, const Words& b) { return a < b ? a : b; }
Words most(const Words& a, const Words& b) { return a > b ? a : b; }

void read_row(const GridPoints& points, std::ptrdiff_t x, std::ptrdiff_t y, Rows& rows) {
  std::int32_t* const fine = rows.fine[Rows::slot(y)];
  std::uint16_t* const coarse = rows.coarse[Rows::slot(y)];
  const bool is_row = y >= 0 && y < points.height;
  const std::ptrdiff_t from = x < side ? side - x : 0, rest = points.width - x + side;
  const std::ptrdiff_t to = is_row ? (rest < wide ? rest : wide) : from;
  const float* const xyz = points.xyz + 3 * (y * points.width + x - side);
  if (is_row && y + 1 < points.height) {
    for (std::ptrdiff_t i = from; i < to; i += 4) __builtin_prefetch(xyz + 3 * (points.width + i));
  }
  for (std::ptrdiff_t i = 0; i < from; ++i) fine[i] = 0;
  for (std::ptrdiff_t i = from; i < to; ++i) {
    const float depth = points.axis[0] * xyz[3 * i] + points.axis[1] * xyz[3 * i + 1] +
                        points.axis[2] * xyz[3 * i + 2] + points.offset;
    const float value = points.scale / depth;
    const bool usable = (value >= 1.0F) & (value < static_cast<float>(most_inverse));
    fine[i] = static_cast<std::int32_t>(usable ? value : 0.0F);
  }
  for (std::ptrdiff_t i = to; i < wide; ++i) fine[i] = 0;
  for (std::ptrdiff_t i = 0; i < wide; ++i) {
    const std::int32_t shifted = fine[i] >> coarse_shift, something = fine[i] != 0;
    coarse[i] = static_cast<std::uint16_t>(shifted > something ? shifted : something);
  }
}

// From the windows about row y - 1 to those about row y: what was row j is row j - 1.
void advance(const Rows& rows, std::ptrdiff_t y, ColumnSums& sums) {
  constexpr std::int16_t in_j = reach, out_j = reach + 1;
  const std::ptrdiff_t entering = Rows::slot(y + reach), leaving = Rows::slot(y - reach - 1);
  const std::uint16_t *coarse_in = rows.coarse[entering], *coarse_out = rows.coarse[leaving];
  for (std::ptrdiff_t i = 0; i < wide; i += short_lanes) {
    const Shorts in = words(coarse_in + i) != 0, out = words(coarse_out + i) != 0;  // -1 where a pixel is
    Shorts &w = shorts(sums.w + i), &jw = shorts(sums.jw + i), &jjw = shorts(sums.jjw + i);
    jjw += w - 2 * jw - in_j * in_j * in + out_j * out_j * out;
    jw -= w + in_j * in + out_j * out;
    w += out - in;
  }
  const std::int32_t *fine_in = rows.fine[entering], *fine_out = rows.fine[leaving];
  for (std::ptrdiff_t i = 0; i < wide; i += int_lanes) {
    const Ints &in = ints(fine_in + i), &out = ints(fine_out + i);
    Ints &d = ints(sums.d + i), &jd = ints(sums.jd + i);
    jd += in_j * in + out_j * out - d;
    d += in - out;
  }
}

// Least and greatest coarse value of each column; those of an empty one are 65535 and 0.
struct ColumnRanges {
  std::uint16_t least[wide], most[wide];  // the least less 1, by which nothing becomes 65535
};

void find_ranges(const Rows& rows, std::ptrdiff_t y, ColumnRanges& ranges) {
  for (std::ptrdiff_t i = 0; i < wide; i += short_lanes) {
    Words high = words(rows.coarse[Rows::slot(y)] + i), low = high - 1;
    for (int j = 1; j <= reach; ++j) {
      const Words before = words(rows.coarse[Rows::slot(y - j)] + i);
      const Words after = words(rows.coarse[Rows::slot(y + j)] + i);
      high = most(high, most(before, after));
      low = least(low, least(before - 1, after - 1));
    }
    words(ranges.least + i) = low;
    words(ranges.most + i) = high;
  }
}

void find_mixed(const std::uint16_t* middle, const ColumnRanges& ranges, std::int32_t noise_fine,
                std::uint16_t* mixed) {
  const auto noise = static_cast<std::uint16_t>(noise_fine >> coarse_shift);
  for (std::ptrdiff_t i = 0; i < strip; i += short_lanes) {
    Words low = words(ranges.least + side + i), high = words(ranges.most + side + i);
    for (int k = 1; k <= reach; ++k) {
      low = least(low, least(words(ranges.least + side + i - k), words(ranges.least + side + i + k)));
      high = most(high, most(words(ranges.most + side + i - k), words(ranges.most + side + i + k)));
    }
    const Words here = words(middle + side + i), one_surface = most(here >> surface_shift, Words{} + noise);
    const Words away = most(high - here, here - (low + 1)) + 1;  // 1: what the coarse values leave out
    words(mixed + i) = Words((away > one_surface) & (here != 0));
  }
}

// Where there are pixels.
void add_counts(const ColumnSums& columns, std::ptrdiff_t i, WindowSums& sums) {
  const std::int16_t *w = columns.w + side + i, *jw = columns.jw + side + i, *jjw = columns.jjw + side + i;
  Shorts n = shorts(w), j = shorts(jw), jj = shorts(jjw), k_sum{}, kk{}, kj{};
  for (std::int16_t k = 1; k <= reach; ++k) {
    const Shorts both = shorts(w + k) + shorts(w - k);
    n += both;
    kk += static_cast<std::int16_t>(k * k) * both;
    k_sum += k * (shorts(w + k) - shorts(w - k));
    j += shorts(jw + k) + shorts(jw - k);
    kj += k * (shorts(jw + k) - shorts(jw - k));
    jj += shorts(jjw + k) + shorts(jjw - k);
  }
  shorts(sums.n + i) = n;
  shorts(sums.k + i) = k_sum;
  shorts(sums.j + i) = j;
  shorts(sums.kk + i) = kk;
  shorts(sums.kj + i) = kj;
  shorts(sums.jj + i) = jj;
}

// What they say.
void add_values(const ColumnSums& columns, std::ptrdiff_t i, WindowSums& sums) {
  const std::int32_t *column = columns.d + side + i, *j_column = columns.jd + side + i;
  Ints d = ints(column), jd = ints(j_column), kd{};
  for (int k = 1; k <= reach; ++k) {
    d += ints(column + k) + ints(column - k);
    kd += k * (ints(column + k) - ints(column - k));
    jd += ints(j_column + k) + ints(j_column - k);
  }
  ints(sums.d + i) = d;
  ints(sums.kd + i) = kd;
  ints(sums.jd + i) = jd;
}

// Of the block from pixel i on, with the pixels beside it.
bool is_full(const ColumnSums& columns, std::ptrdiff_t i) {
  Shorts all = shorts(columns.w + i) == window_side;
  for (std::ptrdiff_t lane = short_lanes; lane < block + 2 * side; lane += short_lanes) {
    all &= shorts(columns.w + i + lane) == window_side;
  }
  std::int64_t halves[vector_bytes / 8];
  __builtin_memcpy(halves, &all, sizeof all);
  bool full = true;
  for (const std::int64_t half : halves) full = full && half == -1;
  return full;
}

void add_columns(const ColumnSums& columns, WindowSums& sums) {
  for (std::ptrdiff_t i = 0; i < strip; i += block) {
    sums.full[i / block] = is_full(columns, i);
    for (std::ptrdiff_t lane = 0; lane < block && !sums.full[i / block]; lane += short_lanes) {
      add_counts(columns, i + lane, sums);
    }
  }
  for (std::ptrdiff_t i = 0; i < strip; i += int_lanes) add_values(columns, i, sums);
}

// Says of a full block what it left out.
void spell_out(WindowSums& sums, std::ptrdiff_t of) {
  sums.full[of] = false;
  for (std::ptrdiff_t i = of * block; i < (of + 1) * block; ++i) {
    sums.n[i] = window_size;
    sums.k[i] = sums.j[i] = sums.kj[i] = 0;
    sums.kk[i] = sums.jj[i] = square_sum;
  }
}

// The sums of the window about pixel i of row y over those of its pixels that are of one surface with it.
void add_like(const Rows& rows, std::ptrdiff_t y, std::int32_t noise, std::ptrdiff_t i, WindowSums& sums) {
  if (sums.full[i / block]) spell_out(sums, i / block);
  constexpr int columns = 16, vectors = columns / static_cast<int>(int_lanes);
  static_assert(2 * reach + 1 <= columns);
  const std::ptrdiff_t left = i + side - reach;
  const std::int32_t here = rows.fine[Rows::slot(y)][i + side], share = here >> surface_shift;
  const std::int32_t allowed = share > noise ? share : noise;
  const std::int32_t below = allowed < here ? here - allowed - 1 : 0, above = here + allowed + 1;
  std::int32_t w[columns], jw[columns], jjw[columns], d[columns], jd[columns];
  for (int v = 0; v < vectors; ++v) {
    // Sums of sums count a row once for each row from it on, m = reach + 1 - j times; the third m (m + 1) / 2
    // times.
    Ints w_once{}, w_twice{}, w_thrice{}, d_once{}, d_twice{};
    for (int j = -reach; j <= reach; ++j) {
      const Ints value = ints(rows.fine[Rows::slot(y + j)] + left + v * int_lanes);
      const Ints like = (value > below) & (value < above);
      w_once -= like;
      w_twice += w_once;
      w_thrice += w_twice;
      d_once += value & like;
      d_twice += d_once;
    }
    constexpr int m_j = reach + 1;  // m + j
    ints(w + v * int_lanes) = w_once;
    ints(jw + v * int_lanes) = m_j * w_once - w_twice;
    ints(jjw + v * int_lanes) = m_j * m_j * w_once - (2 * m_j + 1) * w_twice + 2 * w_thrice;
    ints(d + v * int_lanes) = d_once;
    ints(jd + v * int_lanes) = m_j * d_once - d_twice;
  }
  std::int32_t n = 0, k_sum = 0, j_sum = 0, kk = 0, kj = 0, jj = 0, d_sum = 0, kd = 0, jd_sum = 0;
  for (int column = 0; column <= 2 * reach; ++column) {
    const int k = column - reach;
    n += w[column];
    k_sum += k * w[column];
    kk += k * k * w[column];
    j_sum += jw[column];
    kj += k * jw[column];
    jj += jjw[column];
    d_sum += d[column];
    kd += k * d[column];
    jd_sum += jd[column];
  }
  sums.n[i] = static_cast<std::int16_t>(n);
  sums.k[i] = static_cast<std::int16_t>(k_sum);
  sums.j[i] = static_cast<std::int16_t>(j_sum);
  sums.kk[i] = static_cast<std::int16_t>(kk);
  sums.kj[i] = static_cast<std::int16_t>(kj);
  sums.jj[i] = static_cast<std::int16_t>(jj);
  sums.d[i] = d_sum;
  sums.kd[i] = kd;
  sums.jd[i] = jd_sum;
}

}  // namespace
}  // namespace patchlab
