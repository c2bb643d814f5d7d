#include "engine/region/lasso_candidates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "engine/region/projector.h"

namespace patchlab {
namespace {

constexpr auto margin = static_cast<float>(PolygonMask::margin);

float dot(const std::array<float, 4>& c, float x, float y, float z) {
  return c[0] * x + c[1] * y + c[2] * z + c[3];
}

// Points that may be in the grid, and the cells that they are seen in.
struct OnGrid {
  std::array<std::int32_t, LassoCandidates::capacity + 8> cells;  // room for a vector
  std::array<std::uint32_t, LassoCandidates::capacity + 8> points;
  std::size_t count = 0;
};

// As PolygonMask::Grid has it: a cell that stands for no place and leaves everything open.
std::int32_t unsure_cell(const PolygonMask::Grid& grid) {
  return static_cast<std::int32_t>(grid.columns * grid.rows + 1);
}

void add_one(const CellCamera& camera, const PolygonMask::Grid& grid, const float* q, std::uint32_t number,
             OnGrid& found) {
  const float depth = dot(camera.depth, q[0], q[1], q[2]);
  const float rounding = dot(camera.rounding, std::abs(q[0]), std::abs(q[1]), std::abs(q[2]));
  const float w = camera.perspective ? depth : 1.0F;
  const float column = dot(camera.column, q[0], q[1], q[2]) / w, row = dot(camera.row, q[0], q[1], q[2]) / w;
  const bool sure =
      rounding < margin * w && rounding < depth - camera.near_plane && rounding < camera.far_plane - depth;
  const bool on_grid = column >= 0.0F && row >= 0.0F && column < static_cast<float>(grid.columns) &&
                       row < static_cast<float>(grid.rows);
  const bool hidden = depth < camera.near_plane - rounding || depth > camera.far_plane + rounding ||
                      std::isnan(q[0] + q[1] + q[2]);
  if (sure ? !on_grid : hidden) return;
  found.cells[found.count] = sure ? static_cast<std::int32_t>(row) * static_cast<std::int32_t>(grid.columns) +
                                        static_cast<std::int32_t>(column)
                                  : unsure_cell(grid);
  found.points[found.count++] = number;
}

// Without branches: in which cells points lie follows no pattern.
void judge(const PolygonMask::Grid& grid, const OnGrid& seen, LassoCandidates& found) {
  static_assert(PolygonMask::outside == 0 && PolygonMask::inside == 1 && PolygonMask::on_edge == 2);
  const PolygonMask::Cell* const cells = grid.cells;
  std::size_t count = 0, open = 0;
  for (std::size_t i = 0; i < seen.count; ++i) {
    const unsigned cell = cells[seen.cells[i]];  // 0 outside, 1 inside, 2 on an edge
    found.points[count] = seen.points[i];
    found.open[open] = static_cast<std::uint32_t>(count);
    open += cell >> 1U;
    count += (cell | cell >> 1U) & 1U;
  }
  found.count = count;
  found.open_count = open;
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

// Which of eight points are hidden: looked at only where some are not sure.
[[gnu::target("avx2,fma")]] unsigned hidden_of(const CellCamera& camera, const EightPoints& q, __m256 depth,
                                               __m256 rounding) {
  const __m256 nearer =
      _mm256_cmp_ps(depth, _mm256_sub_ps(_mm256_set1_ps(camera.near_plane), rounding), _CMP_LT_OQ);
  const __m256 farther =
      _mm256_cmp_ps(depth, _mm256_add_ps(_mm256_set1_ps(camera.far_plane), rounding), _CMP_GT_OQ);
  const __m256 sum = _mm256_add_ps(_mm256_add_ps(q.x, q.y), q.z);
  const __m256 no_number = _mm256_cmp_ps(sum, sum, _CMP_UNORD_Q);
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_or_ps(_mm256_or_ps(nearer, farther), no_number)));
}

// For each mask of eight, the places of its bits, a nibble each.
constexpr std::array<std::uint32_t, 256> places_of_bits = [] {
  std::array<std::uint32_t, 256> places = {};
  for (std::uint32_t mask = 0; mask < 256; ++mask) {
    std::uint32_t count = 0;
    for (std::uint32_t bit = 0; bit < 8; ++bit) {
      if ((mask >> bit & 1U) != 0) places[mask] |= bit << (4 * count++);
    }
  }
  return places;
}();

// Writes those of eight points whose bit is set, from place `at` on.
[[gnu::target("avx2,fma")]] inline void write_some(unsigned mask, __m256i cells, __m256i numbers,
                                                   std::size_t at, OnGrid& found) {
  const __m256i nibbles = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
  const __m256i packed = _mm256_set1_epi32(static_cast<int>(places_of_bits[mask]));
  const __m256i places = _mm256_srlv_epi32(packed, nibbles);  // of which three bits count
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(found.cells.data() + at),
                      _mm256_permutevar8x32_epi32(cells, places));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(found.points.data() + at),
                      _mm256_permutevar8x32_epi32(numbers, places));
}

// The first points, eight at a time: as many as are returned.
[[gnu::target("avx2,fma,popcnt")]] std::size_t add_eights(const CellCamera camera,
                                                          const PolygonMask::Grid grid, const float* xyz,
                                                          std::size_t count, std::uint32_t first,
                                                          OnGrid& found) {
  const __m256 no_sign = _mm256_castsi256_ps(_mm256_set1_epi32(0x7fffffff)), zero = _mm256_setzero_ps();
  const __m256 one = _mm256_set1_ps(1.0F), columns = _mm256_set1_ps(static_cast<float>(grid.columns));
  const __m256 rows = _mm256_set1_ps(static_cast<float>(grid.rows));
  __m256i numbers =
      _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  std::size_t i = 0, n = 0;
  for (; i + 8 <= count; i += 8, numbers = _mm256_add_epi32(numbers, _mm256_set1_epi32(8))) {
    const EightPoints q = load_eight(xyz + 3 * i);
    const EightPoints sizes = {_mm256_and_ps(q.x, no_sign), _mm256_and_ps(q.y, no_sign),
                               _mm256_and_ps(q.z, no_sign)};
    const __m256 depth = dot(camera.depth, q), rounding = dot(camera.rounding, sizes);
    const __m256 w = camera.perspective ? depth : one, a_w = _mm256_div_ps(one, w);
    const __m256 column = _mm256_mul_ps(dot(camera.column, q), a_w),
                 row = _mm256_mul_ps(dot(camera.row, q), a_w);
    const __m256 planes = _mm256_min_ps(_mm256_sub_ps(depth, _mm256_set1_ps(camera.near_plane)),
                                        _mm256_sub_ps(_mm256_set1_ps(camera.far_plane), depth));
    const __m256 room = _mm256_min_ps(planes, _mm256_mul_ps(_mm256_set1_ps(margin), w));
    const __m256 sure = _mm256_cmp_ps(room, rounding, _CMP_GT_OQ);
    const __m256 after =
        _mm256_and_ps(_mm256_cmp_ps(column, zero, _CMP_GE_OQ), _mm256_cmp_ps(row, zero, _CMP_GE_OQ));
    const __m256 before =
        _mm256_and_ps(_mm256_cmp_ps(column, columns, _CMP_LT_OQ), _mm256_cmp_ps(row, rows, _CMP_LT_OQ));
    auto mask = static_cast<unsigned>(_mm256_movemask_ps(_mm256_and_ps(_mm256_and_ps(after, before), sure)));
    const unsigned unsure = 255U & ~static_cast<unsigned>(_mm256_movemask_ps(sure));
    if (unsure != 0) mask |= unsure & ~hidden_of(camera, q, depth, rounding);
    if (mask == 0) continue;
    const __m256 whole_row = _mm256_round_ps(row, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    const __m256 whole_column = _mm256_round_ps(column, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    const __m256i cells =
        _mm256_cvttps_epi32(_mm256_fmadd_ps(whole_row, columns, whole_column));  // below 2^24: exact
    const __m256i nowhere = _mm256_set1_epi32(unsure_cell(grid));
    write_some(mask, _mm256_blendv_epi8(nowhere, cells, _mm256_castps_si256(sure)), numbers, n, found);
    n += static_cast<std::size_t>(__builtin_popcount(mask));
  }
  found.count = n;
  return i;
}

bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("popcnt");
}
#endif

}  // namespace

// Each of the three linear forms sums four products: 6 roundings of 2^-24 of the sum of their sizes bound its
// error. A column is at most `side`, so the error of its division is that of column.q plus side times that of
// w. Twice that and more is allowed for, which holds what the bound itself is rounded by.
CellCamera cell_camera(const ViewCamera& camera, const Eigen::Vector3d& origin,
                       const PolygonMask::Grid& grid) {
  constexpr double allowed = 16.0 / (1 << 24);
  const Projector projector(camera);
  const Eigen::Matrix<double, 3, 4> view = projector.view_from(origin);  // x right, y down, z depth
  const Eigen::Vector2d shift = grid.cells_a_pixel * (projector.centre() - grid.low);
  const double scale = grid.cells_a_pixel * projector.pixels();
  const Eigen::RowVector4d depth = view.row(2),
                           one = camera.perspective ? depth : Eigen::RowVector4d(0, 0, 0, 1);
  const Eigen::RowVector4d column = scale * view.row(0) + shift.x() * one,
                           row = scale * view.row(1) + shift.y() * one;
  const auto side = static_cast<double>(std::max(grid.columns, grid.rows));
  const Eigen::RowVector4d rounding =
      allowed * (column.cwiseAbs().cwiseMax(row.cwiseAbs()) + side * one.cwiseAbs() + depth.cwiseAbs());
  const auto narrow = [](const Eigen::RowVector4d& v) {
    const Eigen::RowVector4f f = v.cast<float>();
    return std::array<float, 4>{f[0], f[1], f[2], f[3]};
  };
  return {narrow(column),
          narrow(row),
          narrow(depth),
          narrow(rounding),
          static_cast<float>(camera.near_plane),
          static_cast<float>(camera.far_plane),
          camera.perspective};
}

void find_candidates_plain(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                           std::size_t count, std::uint32_t first, LassoCandidates& found) {
  OnGrid seen;
  for (std::size_t i = 0; i < count; ++i)
    add_one(camera, grid, xyz + 3 * i, first + static_cast<std::uint32_t>(i), seen);
  judge(grid, seen, found);
}

void find_candidates(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                     std::size_t count, std::uint32_t first, LassoCandidates& found) {
  OnGrid seen;
  std::size_t i = 0;
#if defined(__x86_64__)
  if (has_avx2()) i = add_eights(camera, grid, xyz, count, first, seen);
#endif
  for (; i < count; ++i) add_one(camera, grid, xyz + 3 * i, first + static_cast<std::uint32_t>(i), seen);
  judge(grid, seen, found);
}

}  // namespace patchlab
