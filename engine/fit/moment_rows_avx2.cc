#include "engine/fit/moment_rows_kernel.h"

namespace patchlab {

const MomentKernel* avx2_moment_rows() {
#if defined(__AVX2__) && defined(__FMA__)
  static constexpr MomentKernel kernel = {"AVX2", footprints, feet_rows, plain_rows_of, add_outer};
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &kernel : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace patchlab
