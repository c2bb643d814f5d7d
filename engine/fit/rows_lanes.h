// Numbers of as many samples as one instruction takes, and what the kernels of rows do with them. Each
// rows_*.cc compiles this for its own instructions, in an unnamed namespace: what is compiled for one machine
// cannot be linked into what runs on another.
#pragma once

#include "engine/fit/rows.h"

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace patchlab {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t width = 8;
#elif defined(__AVX__)
constexpr std::size_t width = 4;
#else
constexpr std::size_t width = 1;
#endif
#ifdef __AVX__
using Lanes = double __attribute__((vector_size(8 * width), may_alias));
#else
using Lanes = double;
#endif
using Mask = decltype(Lanes{} < Lanes{});

struct Vec {
  Lanes x, y, z;
};
struct Sym {
  Lanes xx, xy, xz, yy, yz, zz;
};

inline Lanes all(double number) { return Lanes{} + number; }
inline Lanes dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec scaled(const Vec& a, const Lanes& s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec difference(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec product(const Sym& S, const Vec& v) {
  return {S.xx * v.x + S.xy * v.y + S.xz * v.z, S.xy * v.x + S.yy * v.y + S.yz * v.z,
          S.xz * v.x + S.yz * v.y + S.zz * v.z};
}
inline Lanes trace(const Sym& S) { return S.xx + S.yy + S.zz; }

#if defined(__AVX512F__)
inline Lanes root(const Lanes& v) { return _mm512_maskz_sqrt_pd(0xff, v); }
#elif defined(__AVX__)
inline Lanes root(const Lanes& v) { return _mm256_sqrt_pd(v); }
#else
inline Lanes root(Lanes v) { return __builtin_sqrt(v); }
#endif
#ifdef __AVX__
inline bool any(const Mask& mask) {
  auto either = mask[0];
  for (std::size_t i = 1; i < width; ++i) either |= mask[i];
  return either != 0;
}
#else
inline bool any(Mask mask) { return mask; }
#endif

inline Lanes& lanes(double* numbers) { return *reinterpret_cast<Lanes*>(numbers); }
inline const Lanes& lanes(const double* numbers) { return *reinterpret_cast<const Lanes*>(numbers); }
inline void store(double (*to)[block_size], std::size_t at, const Vec& v) {
  lanes(to[0] + at) = v.x;
  lanes(to[1] + at) = v.y;
  lanes(to[2] + at) = v.z;
}
inline Vec load(const double (*from)[block_size], std::size_t at) {
  return {lanes(from[0] + at), lanes(from[1] + at), lanes(from[2] + at)};
}

// Asks for a share of the block after this one, so that all of it is at hand when its turn comes: nine rows
// side by side are more streams than the hardware foresees.
inline void prefetch_next(const SampleBlock& block, std::size_t at) {
  constexpr std::size_t line = 64, steps = block_size / width;
  constexpr std::size_t lines = (sizeof(SampleBlock) / line + steps - 1) / steps;
  const char* next = reinterpret_cast<const char*>(&block + 1) + at / width * lines * line;
  for (std::size_t i = 0; i < lines; ++i) __builtin_prefetch(next + i * line);
}

}  // namespace
}  // namespace patchlab
