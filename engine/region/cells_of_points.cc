#include "engine/region/cells_of_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "engine/region/projector.h"

namespace patchlab {
namespace {

inline float absolute(float v) { return v < 0.0f ? -v : v; }
inline float dot(const std::array<float, 4>& c, float x, float y, float z) {
  return c[0] * x + c[1] * y + c[2] * z + c[3];
}
// Not a number becomes 0.
inline std::int32_t clamped(float v, std::int32_t count) {
  const float last = static_cast<float>(count - 1), low = v > 0.0f ? v : 0.0f;
  return static_cast<std::int32_t>(low < last ? low : last);
}

template <bool perspective>
[[gnu::always_inline]] inline void cells_of(const CellCamera camera, const float* xyz, std::size_t count,
                                            std::int32_t* cells) {
  constexpr auto margin = static_cast<float>(PolygonMask::margin);
  const std::int32_t nowhere = camera.columns * camera.rows, unsure = nowhere + 1;
  const auto columns = static_cast<float>(camera.columns), rows = static_cast<float>(camera.rows);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = xyz[3 * i], y = xyz[3 * i + 1], z = xyz[3 * i + 2];
    const float depth = dot(camera.depth, x, y, z);
    const float rounding = dot(camera.rounding, absolute(x), absolute(y), absolute(z));
    const float w = perspective ? depth : 1.0f, a_w = perspective ? 1.0f / depth : 1.0f;
    const float column = dot(camera.column, x, y, z) * a_w, row = dot(camera.row, x, y, z) * a_w;
    const bool on_grid = (column >= 0.0f) & (row >= 0.0f) & (column < columns) & (row < rows);
    const bool sure = (rounding < margin * w) & (depth > camera.near_plane + rounding) &
                      (depth < camera.far_plane - rounding);
    const float sum = x + y + z;
    const bool hidden =
        (depth < camera.near_plane - rounding) | (depth > camera.far_plane + rounding) | (sum != sum);
    const std::int32_t cell = clamped(row, camera.rows) * camera.columns + clamped(column, camera.columns);
    cells[i] = sure ? (on_grid ? cell : nowhere) : (hidden ? nowhere : unsure);
  }
}

[[gnu::always_inline]] inline void cells_for_either(const CellCamera& camera, const float* xyz,
                                                    std::size_t count, std::int32_t* cells) {
  if (camera.perspective)
    cells_of<true>(camera, xyz, count, cells);
  else
    cells_of<false>(camera, xyz, count, cells);
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] void cells_of_points_avx2(const CellCamera& camera, const float* xyz,
                                                      std::size_t count, std::int32_t* cells) {
  cells_for_either(camera, xyz, count, cells);
}

// Eight at a time: most of a scan lies outside together.
[[gnu::target("avx2")]] std::size_t not_outside_avx2(const PolygonMask::Grid& grid, const std::int32_t* cells,
                                                     std::size_t count, std::uint32_t* indices) {
  static_assert(PolygonMask::outside == 0 && sizeof(PolygonMask::Cell) == 1);
  const __m256i low_byte = _mm256_set1_epi32(255), none = _mm256_setzero_si256();
  const auto* const bytes = reinterpret_cast<const int*>(grid.cells);
  std::size_t found = 0, i = 0;
  for (; i + 8 <= count; i += 8) {
    const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(cells + i));
    const __m256i cell = _mm256_and_si256(_mm256_i32gather_epi32(bytes, at, 1), low_byte);
    const __m256i outside = _mm256_cmpeq_epi32(cell, none);
    auto rest = 255U & ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(outside)));
    for (; rest != 0; rest &= rest - 1) {
      indices[found++] = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(__builtin_ctz(rest));
    }
  }
  const std::size_t more = not_outside_plain(grid, cells + i, count - i, indices + found);
  for (std::size_t k = 0; k < more; ++k) indices[found + k] += static_cast<std::uint32_t>(i);
  return found + more;
}

bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
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
          static_cast<std::int32_t>(grid.columns),
          static_cast<std::int32_t>(grid.rows),
          camera.perspective};
}

void cells_of_points_plain(const CellCamera& camera, const float* xyz, std::size_t count,
                           std::int32_t* cells) {
  cells_for_either(camera, xyz, count, cells);
}

void cells_of_points(const CellCamera& camera, const float* xyz, std::size_t count, std::int32_t* cells) {
#if defined(__x86_64__)
  if (has_avx2()) return cells_of_points_avx2(camera, xyz, count, cells);
#endif
  cells_of_points_plain(camera, xyz, count, cells);
}

std::size_t not_outside_plain(const PolygonMask::Grid& grid, const std::int32_t* cells, std::size_t count,
                              std::uint32_t* indices) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    indices[found] = static_cast<std::uint32_t>(i);
    found += grid.cells[cells[i]] != PolygonMask::outside;
  }
  return found;
}

std::size_t not_outside(const PolygonMask::Grid& grid, const std::int32_t* cells, std::size_t count,
                        std::uint32_t* indices) {
#if defined(__x86_64__)
  if (has_avx2()) return not_outside_avx2(grid, cells, count, indices);
#endif
  return not_outside_plain(grid, cells, count, indices);
}

}  // namespace patchlab
