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

// Points to be looked up, and in which cell, counted row by row.
struct CellQueries {
  std::array<std::int32_t, LassoCandidates::capacity + 8> cells;  // room for a vector
  std::array<std::uint32_t, LassoCandidates::capacity + 8> points;
  std::size_t count = 0;
};

// Adds those of eight points whose bit is set.
[[gnu::target("avx2,popcnt")]] inline void add_some(unsigned mask, __m256i cells, __m256i points,
                                                    CellQueries& queries) {
  const __m256i nibbles = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
  const __m256i packed = _mm256_set1_epi32(static_cast<int>(places_of_bits[mask]));
  const __m256i places = _mm256_srlv_epi32(packed, nibbles);  // of which three bits count
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(queries.cells.data() + queries.count),
                      _mm256_permutevar8x32_epi32(cells, places));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(queries.points.data() + queries.count),
                      _mm256_permutevar8x32_epi32(points, places));
  queries.count += static_cast<std::size_t>(__builtin_popcount(mask));
}

// Eight cells at once: pays where all eight are wanted.
[[gnu::target("avx2")]] inline void answer_eight(const PolygonMask::Grid& grid, __m256i cells,
                                                 std::size_t byte, LassoCandidates& found) {
  const __m256i words =
      _mm256_i32gather_epi32(reinterpret_cast<const int*>(grid.words), _mm256_srli_epi32(cells, 4), 4);
  const __m256i place = _mm256_slli_epi32(_mm256_and_si256(cells, _mm256_set1_epi32(15)), 1);
  const __m256i cell = _mm256_srlv_epi32(words, place);
  const unsigned open = bits_of(_mm256_castsi256_ps(_mm256_slli_epi32(cell, 30)));
  const unsigned inside = bits_of(_mm256_castsi256_ps(_mm256_slli_epi32(cell, 31)));
  reinterpret_cast<unsigned char*>(found.points.data())[byte] = static_cast<unsigned char>(inside | open);
  reinterpret_cast<unsigned char*>(found.open.data())[byte] = static_cast<unsigned char>(open);
}

// The first points, eight at a time: as many as are returned.
template <bool perspective>
[[gnu::target("avx2,fma,popcnt")]] std::size_t add_eights(const CellCamera camera,
                                                          const PolygonMask::Grid grid, const float* xyz,
                                                          std::size_t count, LassoCandidates& found,
                                                          CellQueries& queries) {
  const __m256 zero = _mm256_setzero_ps(), one = _mm256_set1_ps(1.0F);
  const __m256 columns = _mm256_set1_ps(static_cast<float>(grid.columns)),
               rows = _mm256_set1_ps(static_cast<float>(grid.rows));
  const __m256 sure_from = _mm256_set1_ps(camera.sure_from), sure_to = _mm256_set1_ps(camera.sure_to);
  const __m256 cells_a_row = _mm256_set1_ps(static_cast<float>(grid.words_a_row * PolygonMask::cells_a_word));
  const __m256i unsure_cell = _mm256_set1_epi32(static_cast<int>(grid.unsure_cell()));
  const __m256i eight = _mm256_set1_epi32(8);
  __m256i points = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8, points = _mm256_add_epi32(points, eight)) {
    __builtin_prefetch(xyz + 3 * i + 256);
    __builtin_prefetch(xyz + 3 * i + 272);
    const EightPoints q = load_eight(xyz + 3 * i);
    const __m256 depth = dot(camera.depth, q), w = perspective ? depth : one;
    const __m256 column = dot(camera.column, q), row = dot(camera.row, q);
    const __m256 room =
        _mm256_min_ps(_mm256_min_ps(column, row),
                      _mm256_min_ps(_mm256_fmsub_ps(columns, w, column), _mm256_fmsub_ps(rows, w, row)));
    const __m256 on_grid = _mm256_cmp_ps(room, zero, _CMP_GE_OQ);
    const __m256 sure =
        _mm256_and_ps(_mm256_cmp_ps(depth, sure_from, _CMP_GT_OQ), _mm256_cmp_ps(depth, sure_to, _CMP_LT_OQ));
    unsigned mask = bits_of(_mm256_and_ps(on_grid, sure));
    const unsigned unsure = 255U & ~bits_of(sure);
    if (unsure != 0) mask |= unsure & ~hidden_of(camera, q, depth);
    if (mask == 0) continue;
    const __m256 a_w = _mm256_div_ps(one, w);
    const __m256 whole_row = _mm256_round_ps(_mm256_mul_ps(row, a_w), _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    const __m256 whole_column =
        _mm256_round_ps(_mm256_mul_ps(column, a_w), _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    const __m256i cells = _mm256_min_epu32(
        _mm256_cvttps_epi32(_mm256_fmadd_ps(whole_row, cells_a_row, whole_column)),  // below 2^24: exact
        unsure_cell);
    const __m256i known = _mm256_blendv_epi8(unsure_cell, cells, _mm256_castps_si256(sure));
    if (mask == 255)
      answer_eight(grid, known, i / 8, found);
    else
      add_some(mask, known, points, queries);
  }
  return i;
}

// Without branches: in which cells points lie follows no pattern.
[[gnu::target("avx2,bmi2")]] void answer(const PolygonMask::Grid& grid, const CellQueries& queries,
                                         LassoCandidates& found) {
  static_assert(PolygonMask::outside == 0 && PolygonMask::inside == 1 && PolygonMask::on_edge == 2);
  alignas(32) std::array<std::uint8_t, LassoCandidates::capacity> cells = {};
  const std::uint32_t* const words = grid.words;
  for (std::size_t i = 0; i < queries.count; ++i) {
    const auto cell = static_cast<std::uint32_t>(queries.cells[i]);
    cells[queries.points[i]] = static_cast<std::uint8_t>(words[cell / 16] >> 2 * (cell % 16) & 3U);
  }
  for (std::size_t i = 0; i < cells.size(); i += 32) {
    const __m256i some = _mm256_load_si256(reinterpret_cast<const __m256i*>(cells.data() + i));
    const __m256i open = _mm256_slli_epi16(some, 6);  // the upper of each two bits comes first
    const auto o = static_cast<std::uint32_t>(_mm256_movemask_epi8(open));
    const auto c =
        static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_or_si256(open, _mm256_slli_epi16(some, 7))));
    found.open[i / 64] |= std::uint64_t{o} << i % 64;
    found.points[i / 64] |= std::uint64_t{c} << i % 64;
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
  std::size_t i = 0;
  for (; i < bits.size() && written + 64 + 8 <= numbers.size(); ++i) {
    __m256i number = _mm256_set1_epi32(static_cast<int>(first + 64 * static_cast<std::uint32_t>(i)));
    std::uint64_t word = bits[i];
    if (word == 0) continue;
    for (int k = 0; k < 8; ++k, word >>= 8) {
      const auto byte = static_cast<unsigned>(word & 255U);
      const __m256i packed = _mm256_set1_epi32(static_cast<int>(places_of_bits[byte]));
      const __m256i places = _mm256_and_si256(_mm256_srlv_epi32(packed, nibbles), three_bits);
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(numbers.data() + written),
                          _mm256_add_epi32(number, places));
      written += static_cast<std::size_t>(__builtin_popcount(byte));
      number = _mm256_add_epi32(number, _mm256_set1_epi32(8));
    }
  }
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
    i = camera.perspective ? add_eights<true>(camera, grid, xyz, count, found, queries)
                           : add_eights<false>(camera, grid, xyz, count, found, queries);
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
