#include "engine/region/lasso_candidates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace patchlab {
namespace {

float dot(const std::array<float, 4>& c, const float* q) {
  return c[0] * q[0] + c[1] * q[1] + c[2] * q[2] + c[3];
}

struct Verdict {
  bool candidate = false, open = false;
};

Verdict judge(const CellCamera& camera, const PolygonMask::Grid& grid, const float* q) {
  const float depth = dot(camera.depth, q), w = camera.perspective ? depth : 1.0F;
  if (!(depth > camera.sure_from && depth < camera.sure_to)) {
    const bool hidden = depth < camera.seen_from || depth > camera.seen_to || std::isnan(q[0] + q[1] + q[2]);
    return {!hidden, !hidden};
  }
  const float column = dot(camera.column, q), row = dot(camera.row, q);
  const bool on_grid = column >= 0.0F && row >= 0.0F && column <= static_cast<float>(grid.columns) * w &&
                       row <= static_cast<float>(grid.rows) * w;
  if (!on_grid) return {};
  const PolygonMask::Cell cell = grid.cell(std::min(static_cast<std::ptrdiff_t>(column / w), grid.columns),
                                           std::min(static_cast<std::ptrdiff_t>(row / w), grid.rows));
  return {cell != PolygonMask::outside, cell == PolygonMask::on_edge};
}

void add_one(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz, std::size_t i,
             LassoCandidates& found) {
  const Verdict verdict = judge(camera, grid, xyz + 3 * i);
  found.points[i / 64] |= std::uint64_t{verdict.candidate} << i % 64;
  found.open[i / 64] |= std::uint64_t{verdict.open} << i % 64;
}

#if defined(__x86_64__)
constexpr std::size_t fetched_ahead = 1024;  // floats fetched before they are needed

struct EightPoints {
  __m256 x, y, z;
};

[[gnu::target("avx2,fma")]] __m256 join(const float* low, const float* high) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
}

// From x0 y0 z0 x1 ...
[[gnu::target("avx2,fma")]] inline EightPoints load_eight(const float* xyz) {
  // Of each half x0 y0 z0 x1 | y1 z1 x2 y2 | z2 x3 y3 z3.
  const __m256 a = join(xyz, xyz + 12), b = join(xyz + 4, xyz + 16), c = join(xyz + 8, xyz + 20);
  const __m256 x_y = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));  // x2 y2 x3 y3
  const __m256 y_z = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));  // y0 z0 y1 z1
  return {_mm256_shuffle_ps(a, x_y, _MM_SHUFFLE(2, 0, 3, 0)),
          _mm256_shuffle_ps(y_z, x_y, _MM_SHUFFLE(3, 1, 2, 0)),
          _mm256_shuffle_ps(y_z, c, _MM_SHUFFLE(3, 0, 3, 1))};
}

[[gnu::target("avx2,fma")]] inline __m256 dot(const std::array<float, 4>& c, const EightPoints& q) {
  const __m256 z = _mm256_fmadd_ps(_mm256_set1_ps(c[2]), q.z, _mm256_set1_ps(c[3]));
  return _mm256_fmadd_ps(_mm256_set1_ps(c[0]), q.x, _mm256_fmadd_ps(_mm256_set1_ps(c[1]), q.y, z));
}

[[gnu::target("avx2,fma")]] inline unsigned bits_of(__m256 lanes) {
  return static_cast<unsigned>(_mm256_movemask_ps(lanes));
}

// Which of eight points are not between the planes, or no numbers.
[[gnu::target("avx2,fma")]] inline unsigned hidden_of(const CellCamera& camera, const EightPoints& q,
                                                      __m256 depth) {
  const __m256 nearer = _mm256_cmp_ps(depth, _mm256_set1_ps(camera.seen_from), _CMP_LT_OQ);
  const __m256 farther = _mm256_cmp_ps(depth, _mm256_set1_ps(camera.seen_to), _CMP_GT_OQ);
  const __m256 sum = _mm256_add_ps(_mm256_add_ps(q.x, q.y), q.z);
  return bits_of(_mm256_or_ps(_mm256_or_ps(nearer, farther), _mm256_cmp_ps(sum, sum, _CMP_UNORD_Q)));
}

// For each byte, the places of its bits, a nibble each.
constexpr std::array<std::uint32_t, 256> places_of_bits = [] {
  std::array<std::uint32_t, 256> places = {};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t count = 0;
    for (std::uint32_t bit = 0; bit < 8; ++bit) {
      if ((byte >> bit & 1U) != 0) places[byte] |= bit << (4 * count++);
    }
  }
  return places;
}();

// The cells in which points are to be looked up, counted row by row, in the order of the points.
struct CellQueries {
  std::array<std::int32_t, LassoCandidates::capacity + 64> cells;  // room for a word of answers
  std::size_t count = 0;
};

// Moves those of eight cells whose bit is set to the front. Of a place, three bits count.
[[gnu::target("avx2")]] inline __m256i pack(unsigned mask, __m256i cells) {
  const __m256i nibbles = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
  const __m256i packed = _mm256_set1_epi32(static_cast<int>(places_of_bits[mask]));
  return _mm256_permutevar8x32_epi32(cells, _mm256_srlv_epi32(packed, nibbles));
}

// A number each of two by eight points: what multiplies both is read once.
struct Two {
  __m256 a, b;
};

[[gnu::target("avx2,fma"), gnu::always_inline]] inline Two dot(const std::array<float, 4>& c,
                                                               const EightPoints& a, const EightPoints& b) {
  const __m256 c0 = _mm256_set1_ps(c[0]), c1 = _mm256_set1_ps(c[1]), c2 = _mm256_set1_ps(c[2]),
               c3 = _mm256_set1_ps(c[3]);
  return {_mm256_fmadd_ps(c0, a.x, _mm256_fmadd_ps(c1, a.y, _mm256_fmadd_ps(c2, a.z, c3))),
          _mm256_fmadd_ps(c0, b.x, _mm256_fmadd_ps(c1, b.y, _mm256_fmadd_ps(c2, b.z, c3)))};
}

// Where eight points are on the grid: columns and rows times w.
struct Places {
  __m256 column, row, w;
};

struct Limits {
  __m256 columns, rows, sure_from, sure_to;
};

// Of some vectors only the signs count: cheaper than as many comparisons and minima. No number, no place on
// the grid: what is infinite or no number is not sure.
[[gnu::target("avx2,fma"), gnu::always_inline]] inline __m256 signs_of_sure(const Limits& limits,
                                                                            __m256 depth) {
  return _mm256_and_ps(_mm256_cmp_ps(depth, limits.sure_from, _CMP_GT_OQ),
                       _mm256_sub_ps(depth, limits.sure_to));
}

[[gnu::target("avx2,fma"), gnu::always_inline]] inline __m256 signs_off_grid(const Limits& limits,
                                                                             const Places& at) {
  const __m256 right = _mm256_fmsub_ps(limits.columns, at.w, at.column);
  const __m256 below = _mm256_fmsub_ps(limits.rows, at.w, at.row);
  return _mm256_or_ps(_mm256_or_ps(at.column, at.row), _mm256_or_ps(right, below));
}

// Puts those not sure into the given cell of the first row.
[[gnu::target("avx2,fma")]] inline void move_unsure(__m256 signs_of_sure, __m256 cell, Places& at) {
  const __m256 one = _mm256_set1_ps(1.0F);
  at = {_mm256_blendv_ps(cell, at.column, signs_of_sure),
        _mm256_blendv_ps(_mm256_setzero_ps(), at.row, signs_of_sure),
        _mm256_blendv_ps(one, at.w, signs_of_sure)};
}

[[gnu::target("avx2,fma"), gnu::always_inline]] inline __m256i cells_of(const Places& at,
                                                                        __m256 cells_a_row) {
  constexpr int whole = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC;
  const __m256 a_w = _mm256_div_ps(_mm256_set1_ps(1.0F), at.w);
  const __m256 row = _mm256_round_ps(_mm256_mul_ps(at.row, a_w), whole);
  const __m256 column = _mm256_round_ps(_mm256_mul_ps(at.column, a_w), whole);
  return _mm256_cvttps_epi32(_mm256_fmadd_ps(row, cells_a_row, column));  // below 2^24: exact
}

// The first points, sixteen at a time: as many as are returned. Marks as candidates those to be looked up.
template <bool perspective>
[[gnu::target("avx2,fma,popcnt")]] std::size_t add_sixteens(const CellCamera& camera,
                                                            const PolygonMask::Grid& grid, const float* xyz,
                                                            std::size_t count, LassoCandidates& found,
                                                            CellQueries& queries) {
  const __m256 one = _mm256_set1_ps(1.0F);
  const Limits limits = {_mm256_set1_ps(static_cast<float>(grid.columns)),
                         _mm256_set1_ps(static_cast<float>(grid.rows)), _mm256_set1_ps(camera.sure_from),
                         _mm256_set1_ps(camera.sure_to)};
  const __m256 cells_a_row = _mm256_set1_ps(static_cast<float>(grid.words_a_row * PolygonMask::cells_a_word));
  const __m256 unsure_cell = _mm256_set1_ps(static_cast<float>(grid.unsure_cell()));
  auto* const wanted = reinterpret_cast<unsigned char*>(found.points.data());
  std::int32_t* next = queries.cells.data();
  std::size_t i = 0;
  for (; i + 16 <= count; i += 16) {
    for (std::size_t line = 0; line < 3; ++line) __builtin_prefetch(xyz + 3 * i + fetched_ahead + 16 * line);
    const EightPoints a = load_eight(xyz + 3 * i), b = load_eight(xyz + 3 * i + 24);
    const Two depth = dot(camera.depth, a, b), w = perspective ? depth : Two{one, one};
    const Two column = dot(camera.column, a, b), row = dot(camera.row, a, b);
    Places at_a = {column.a, row.a, w.a}, at_b = {column.b, row.b, w.b};
    const Two sure = {signs_of_sure(limits, depth.a), signs_of_sure(limits, depth.b)};
    unsigned of_a = bits_of(_mm256_andnot_ps(signs_off_grid(limits, at_a), sure.a));
    unsigned of_b = bits_of(_mm256_andnot_ps(signs_off_grid(limits, at_b), sure.b));
    if (bits_of(_mm256_and_ps(sure.a, sure.b)) != 255U) {
      of_a |= 255U & ~bits_of(sure.a) & ~hidden_of(camera, a, depth.a);
      of_b |= 255U & ~bits_of(sure.b) & ~hidden_of(camera, b, depth.b);
      move_unsure(sure.a, unsure_cell, at_a);
      move_unsure(sure.b, unsure_cell, at_b);
    }
    if ((of_a | of_b) == 0) continue;
    wanted[i / 8] = static_cast<unsigned char>(of_a);
    wanted[i / 8 + 1] = static_cast<unsigned char>(of_b);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(next), pack(of_a, cells_of(at_a, cells_a_row)));
    next += __builtin_popcount(of_a);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(next), pack(of_b, cells_of(at_b, cells_a_row)));
    next += __builtin_popcount(of_b);
  }
  queries.count = static_cast<std::size_t>(next - queries.cells.data());
  return i;
}

// A bit a query, in their order, and a word more, so that one can be read from any bit on.
using Answers = std::array<std::uint64_t, LassoCandidates::capacity / 64 + 1>;

inline std::uint64_t bits_from(const Answers& answers, std::size_t bit) {
  const std::uint64_t low = answers[bit / 64], high = answers[bit / 64 + 1];
  return low >> bit % 64 | high << 1 << (63 - bit % 64);
}

[[gnu::target("avx2,fma"), gnu::always_inline]] inline void look_up_cells(const PolygonMask::Grid& grid,
                                                                          CellQueries& queries,
                                                                          Answers& candidate, Answers& open) {
  static_assert(PolygonMask::outside == 0 && PolygonMask::inside == 1 && PolygonMask::on_edge == 2);
  const __m256i last = _mm256_set1_epi32(static_cast<int>(grid.unsure_cell()));
  for (std::size_t i = 0; i < 64; i += 8)
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(queries.cells.data() + queries.count + i),
                        _mm256_setzero_si256());
  for (std::size_t i = 0; i < queries.count; i += 64) {
    std::uint64_t not_outside = 0, on_edge = 0;
    for (std::size_t k = 0; k < 64; k += 8) {
      const __m256i cells = _mm256_min_epu32(
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(queries.cells.data() + i + k)), last);
      const __m256i words =
          _mm256_i32gather_epi32(reinterpret_cast<const int*>(grid.words), _mm256_srli_epi32(cells, 4), 4);
      const __m256i place = _mm256_slli_epi32(_mm256_and_si256(cells, _mm256_set1_epi32(15)), 1);
      const __m256i cell = _mm256_srlv_epi32(words, place);
      const __m256i edge = _mm256_slli_epi32(cell, 30);
      const __m256i some = _mm256_or_si256(edge, _mm256_slli_epi32(cell, 31));
      on_edge |= std::uint64_t{bits_of(_mm256_castsi256_ps(edge))} << k;
      not_outside |= std::uint64_t{bits_of(_mm256_castsi256_ps(some))} << k;
    }
    candidate[i / 64] = not_outside;
    open[i / 64] = on_edge;
  }
}

// Without branches: in which cells points lie follows no pattern.
[[gnu::target("avx2,fma,bmi2,popcnt")]] void answer(const PolygonMask::Grid& grid, CellQueries& queries,
                                                    LassoCandidates& found) {
  Answers candidate = {}, open = {};
  look_up_cells(grid, queries, candidate, open);
  std::size_t first = 0;
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const std::uint64_t asked = found.points[i];
    found.points[i] = _pdep_u64(bits_from(candidate, first), asked);
    found.open[i] = _pdep_u64(bits_from(open, first), asked);
    first += static_cast<std::size_t>(__builtin_popcountll(asked));
  }
}

[[gnu::target("popcnt")]] std::size_t count_bits_popcnt(std::span<const std::uint64_t> bits) {
  std::size_t count = 0;
  for (const std::uint64_t word : bits) count += static_cast<std::size_t>(__builtin_popcountll(word));
  return count;
}

// Writes eight at a time, of which the next overwrite those too many, while there is place: as many words are
// done as are returned.
[[gnu::target("avx2,popcnt")]] std::size_t write_eights(std::span<const std::uint64_t> bits,
                                                        std::uint32_t first, std::span<std::uint32_t> numbers,
                                                        std::size_t& written) {
  const __m256i nibbles = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28), three_bits = _mm256_set1_epi32(7);
  std::uint32_t* next = numbers.data();
  const std::uint32_t* const end = next + numbers.size();
  std::size_t i = 0;
  for (; i < bits.size() && end - next >= 64 + 8; ++i) {
    __m256i number = _mm256_set1_epi32(static_cast<int>(first + 64 * static_cast<std::uint32_t>(i)));
    std::uint64_t word = bits[i];
    if (word == 0) continue;
    for (int k = 0; k < 8; ++k, word >>= 8) {
      const auto byte = static_cast<unsigned>(word & 255U);
      const __m256i packed = _mm256_set1_epi32(static_cast<int>(places_of_bits[byte]));
      const __m256i places = _mm256_and_si256(_mm256_srlv_epi32(packed, nibbles), three_bits);
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(next), _mm256_add_epi32(number, places));
      next += __builtin_popcount(byte);
      number = _mm256_add_epi32(number, _mm256_set1_epi32(8));
    }
  }
  written = static_cast<std::size_t>(next - numbers.data());
  return i;
}

bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("bmi2");
}
#endif

void write_each(std::span<const std::uint64_t> bits, std::uint32_t first, std::uint32_t* number) {
  for (std::size_t i = 0; i < bits.size(); ++i) {
    for (std::uint64_t word = bits[i]; word != 0; word &= word - 1)
      *number++ =
          first + static_cast<std::uint32_t>(64 * i) + static_cast<std::uint32_t>(std::countr_zero(word));
  }
}

}  // namespace

void find_candidates_plain(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                           std::size_t count, LassoCandidates& found) {
  found = {};
  for (std::size_t i = 0; i < count; ++i) add_one(camera, grid, xyz, i, found);
}

void find_candidates(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                     std::size_t count, LassoCandidates& found) {
  found = {};
  std::size_t i = 0;
#if defined(__x86_64__)
  if (has_avx2()) {
    CellQueries queries;
    i = camera.perspective ? add_sixteens<true>(camera, grid, xyz, count, found, queries)
                           : add_sixteens<false>(camera, grid, xyz, count, found, queries);
    if (queries.count > 0) answer(grid, queries, found);
  }
#endif
  for (; i < count; ++i) add_one(camera, grid, xyz, i, found);
}

std::size_t count_bits(std::span<const std::uint64_t> bits) {
#if defined(__x86_64__)
  if (has_avx2()) return count_bits_popcnt(bits);
#endif
  return std::transform_reduce(
      bits.begin(), bits.end(), std::size_t{0}, std::plus<>(),
      [](std::uint64_t word) { return static_cast<std::size_t>(std::popcount(word)); });
}

void write_numbers_plain(std::span<const std::uint64_t> bits, std::uint32_t first,
                         std::span<std::uint32_t> numbers) {
  write_each(bits, first, numbers.data());
}

void write_numbers(std::span<const std::uint64_t> bits, std::uint32_t first,
                   std::span<std::uint32_t> numbers) {
  std::size_t words = 0, written = 0;
#if defined(__x86_64__)
  if (has_avx2()) words = write_eights(bits, first, numbers, written);
#endif
  write_each(bits.subspan(words), first + 64 * static_cast<std::uint32_t>(words), numbers.data() + written);
}

}  // namespace patchlab
