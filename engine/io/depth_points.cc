#include "engine/io/depth_points.h"

#include <limits>
#include <vector>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace patchlab {
namespace {

constexpr float no_depth = std::numeric_limits<float>::quiet_NaN();
constexpr float largest_float = std::numeric_limits<float>::max();

// A row of pixels and where it goes.
struct PixelRow {
  const std::uint16_t* samples;
  const double* x;  // of each column, at unit depth
  double y, scale;
  float* positions;
  std::uint8_t* finite;
};

// The pixels [first, width).
std::size_t take_pixels(const PixelRow& row, std::size_t first, std::size_t width) {
  std::size_t count = 0;
  for (std::size_t u = first; u < width; ++u) {
    const double z = row.samples[u] / row.scale;
    const bool hole = row.samples[u] == 0;
    const Eigen::Vector3f p = Eigen::Vector3d(row.x[u] * z, row.y * z, z).cast<float>();
    const bool finite = !hole && (p.array().abs() <= largest_float).all();
    for (std::size_t k = 0; k < 3; ++k)
      row.positions[3 * u + k] = hole ? no_depth : p[static_cast<Eigen::Index>(k)];
    row.finite[u] = finite ? 1 : 0;
    count += finite ? 1 : 0;
  }
  return count;
}

#if defined(__x86_64__)
// x0 y0 z0 x1 ... of four points.
[[gnu::target("avx2")]] inline void store_four(__m128 x, __m128 y, __m128 z, float* to) {
  const __m128 z0_x1 = _mm_shuffle_ps(z, x, _MM_SHUFFLE(1, 1, 0, 0)),
               y1_z1 = _mm_shuffle_ps(y, z, _MM_SHUFFLE(1, 1, 1, 1));
  const __m128 z2_x3 = _mm_shuffle_ps(z, x, _MM_SHUFFLE(3, 3, 2, 2)),
               y3_z3 = _mm_shuffle_ps(y, z, _MM_SHUFFLE(3, 3, 3, 3));
  _mm_storeu_ps(to, _mm_shuffle_ps(_mm_unpacklo_ps(x, y), z0_x1, _MM_SHUFFLE(2, 0, 1, 0)));
  _mm_storeu_ps(to + 4, _mm_shuffle_ps(y1_z1, _mm_unpackhi_ps(x, y), _MM_SHUFFLE(1, 0, 2, 0)));
  _mm_storeu_ps(to + 8, _mm_shuffle_ps(z2_x3, y3_z3, _MM_SHUFFLE(2, 0, 2, 0)));
}

// As take_pixels, four pixels at a time: as many as are returned; adds those that are finite to `count`.
[[gnu::target("avx2,popcnt")]] std::size_t take_four_pixels(const PixelRow& row, std::size_t width,
                                                            std::size_t& count) {
  const __m256d y = _mm256_set1_pd(row.y), scale = _mm256_set1_pd(row.scale);
  const __m128 none = _mm_set1_ps(no_depth), most = _mm_set1_ps(largest_float);
  const __m128 no_sign = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
  std::size_t u = 0;
  for (; u + 4 <= width; u += 4) {
    const __m128i sample =
        _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row.samples + u)));
    const __m256d z = _mm256_div_pd(_mm256_cvtepi32_pd(sample), scale);
    const __m128 hole = _mm_castsi128_ps(_mm_cmpeq_epi32(sample, _mm_setzero_si128()));
    const auto narrow = [&](__m256d v) __attribute__((target("avx2"))) {
      return _mm_blendv_ps(_mm256_cvtpd_ps(v), none, hole);
    };
    const __m128 px = narrow(_mm256_mul_pd(_mm256_loadu_pd(row.x + u), z)), py = narrow(_mm256_mul_pd(y, z)),
                 pz = narrow(z);
    store_four(px, py, pz, row.positions + 3 * u);
    const __m128 size = _mm_max_ps(_mm_and_ps(px, no_sign), _mm_max_ps(_mm_and_ps(py, no_sign), pz));
    const __m128 finite = _mm_cmple_ps(size, most);  // not so for NaN, which all three are or none
    const __m128i words = _mm_packs_epi32(_mm_castps_si128(finite), _mm_setzero_si128());
    const __m128i bytes = _mm_and_si128(_mm_packs_epi16(words, words), _mm_set1_epi8(1));
    _mm_storeu_si32(row.finite + u, bytes);
    count += static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(_mm_movemask_ps(finite))));
  }
  return u;
}

bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt"); }
#endif

std::size_t unproject(const DepthPixels& pixels, Eigen::Vector3f* positions, std::uint8_t* finite,
                      [[maybe_unused]] bool plain) {
  const Intrinsics& camera = pixels.camera;
  std::vector<double> x(pixels.width);
  for (std::size_t u = 0; u < x.size(); ++u) x[u] = (static_cast<double>(u) - camera.cx) / camera.fx;
  std::size_t count = 0;
  for (std::size_t v = 0; v * pixels.width < pixels.samples.size(); ++v) {
    const std::size_t at = v * pixels.width;
    const PixelRow row = {pixels.samples.data() + at,
                          x.data(),
                          (static_cast<double>(v) - camera.cy) / camera.fy,
                          pixels.scale,
                          positions[at].data(),
                          finite + at};
    std::size_t first = 0;
#if defined(__x86_64__)
    if (!plain && has_avx2()) first = take_four_pixels(row, pixels.width, count);
#endif
    count += take_pixels(row, first, pixels.width);
  }
  return count;
}

}  // namespace

std::size_t unproject(const DepthPixels& pixels, Eigen::Vector3f* positions, std::uint8_t* finite) {
  return unproject(pixels, positions, finite, false);
}

std::size_t unproject_plain(const DepthPixels& pixels, Eigen::Vector3f* positions, std::uint8_t* finite) {
  return unproject(pixels, positions, finite, true);
}

}  // namespace patchlab
