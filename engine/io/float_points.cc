#include "engine/io/float_points.h"

#include <algorithm>
#include <bit>
#include <cstring>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace patchlab {
namespace {

constexpr float huge_float = 1e7F;    // m: no map projection reaches it
constexpr float tiny_float = 1e-30F;  // m: only damage is smaller, but for zero
constexpr float no_float = std::numeric_limits<float>::quiet_NaN();

float float_at(const char* bytes) {
  float value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// The bits of a float without its sign: in the order of its size, those that are not finite above all others.
constexpr std::uint32_t magnitude(float value) { return std::bit_cast<std::uint32_t>(value) & 0x7fffffffU; }

bool is_strange(float value) {
  const std::uint32_t size = magnitude(value);
  return size > magnitude(huge_float) || (size < magnitude(tiny_float) && size > 0);
}

using Places = std::array<const char*, 3>;

// Points [first, last).
void take_points(const Places& places, const std::array<std::size_t, 3>& strides, std::size_t first,
                 std::size_t last, Eigen::Vector3f* positions, std::uint8_t* finite, FloatSurvey& survey) {
  for (std::size_t i = first; i < last; ++i) {
    std::array<float, 3> p;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = float_at(places[axis] + i * strides[axis]);
    if (std::max({magnitude(p[0]), magnitude(p[1]), magnitude(p[2])}) >= magnitude(FloatSurvey::infinity)) {
      positions[i].setConstant(no_float);
      finite[i] = 0;
      continue;
    }
    positions[i] = {p[0], p[1], p[2]};
    ++survey.finite;
    survey.strange += (is_strange(p[0]) | is_strange(p[1]) | is_strange(p[2])) ? 1 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      survey.low[axis] = std::min(survey.low[axis], p[axis]);
      survey.high[axis] = std::max(survey.high[axis], p[axis]);
    }
  }
}

#if defined(__SSE2__)
constexpr std::size_t points_at_once = 256;

bool any_of_three(__m128 lanes) { return (_mm_movemask_ps(lanes) & 7) != 0; }

void widen(FloatSurvey& survey, __m128 low, __m128 high) {
  std::array<float, 4> least, most;
  _mm_storeu_ps(least.data(), low);
  _mm_storeu_ps(most.data(), high);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    survey.low[axis] = std::min(survey.low[axis], least[axis]);
    survey.high[axis] = std::max(survey.high[axis], most[axis]);
  }
}

// Points of three neighbours in memory, with four bytes more to read and to write behind each. False, and the
// survey as it was, where one is strange.
bool take_block(const char* from, std::size_t stride, std::size_t points, float* to, std::uint8_t* finite,
                FloatSurvey& survey) {
  const __m128 no_sign = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
  const __m128 largest = _mm_set1_ps(huge_float), smallest = _mm_set1_ps(tiny_float), zero = _mm_setzero_ps();
  const __m128 largest_finite = _mm_set1_ps(std::numeric_limits<float>::max()), none = _mm_set1_ps(no_float);
  __m128 low = _mm_set1_ps(FloatSurvey::infinity), high = _mm_set1_ps(-FloatSurvey::infinity), strange = zero;
  std::size_t not_finite = 0;
  for (std::size_t i = 0; i < points; ++i, from += stride, to += 3) {
    const __m128 p = _mm_loadu_ps(reinterpret_cast<const float*>(from)), size = _mm_and_ps(p, no_sign);
    if (any_of_three(_mm_cmpnle_ps(size, largest_finite))) {
      _mm_storeu_ps(to, none);
      finite[i] = 0;
      ++not_finite;
      continue;
    }
    _mm_storeu_ps(to, p);
    low = _mm_min_ps(low, p);
    high = _mm_max_ps(high, p);
    const __m128 small = _mm_and_ps(_mm_cmplt_ps(size, smallest), _mm_cmpneq_ps(size, zero));
    strange = _mm_or_ps(strange, _mm_or_ps(small, _mm_cmpgt_ps(size, largest)));
  }
  if (any_of_three(strange)) return false;
  widen(survey, low, high);
  survey.finite += points - not_finite;
  return true;
}
#endif

Places places_of(const std::array<const Column*, 3>& xyz) {
  return {xyz[0]->first, xyz[1]->first, xyz[2]->first};
}

std::array<std::size_t, 3> strides_of(const std::array<const Column*, 3>& xyz) {
  return {xyz[0]->stride, xyz[1]->stride, xyz[2]->stride};
}

}  // namespace

FloatSurvey take_floats_plain(const std::array<const Column*, 3>& xyz, std::size_t points,
                              Eigen::Vector3f* positions, std::uint8_t* finite) {
  FloatSurvey survey;
  take_points(places_of(xyz), strides_of(xyz), 0, points, positions, finite, survey);
  return survey;
}

FloatSurvey take_floats(const std::array<const Column*, 3>& xyz, std::size_t points,
                        Eigen::Vector3f* positions, std::uint8_t* finite) {
  FloatSurvey survey;
  std::size_t first = 0;
  const Places places = places_of(xyz);
  const std::array<std::size_t, 3> strides = strides_of(xyz);
#if defined(__SSE2__)
  const bool neighbours = points > 1 && places[1] == places[0] + 4 && places[2] == places[0] + 8 &&
                          strides == std::array{strides[0], strides[0], strides[0]};
  while (neighbours && first + 1 < points) {
    const std::size_t count =
        std::min(points_at_once, points - 1 - first);  // behind the last one is nothing to read
    if (!take_block(places[0] + first * strides[0], strides[0], count, positions[first].data(),
                    finite + first, survey))
      take_points(places, strides, first, first + count, positions, finite, survey);
    first += count;
  }
#endif
  take_points(places, strides, first, points, positions, finite, survey);
  return survey;
}

}  // namespace patchlab
