#include "engine/fit/moment_rows_kernel.h"

namespace patchlab {

const MomentKernel* avx512_moment_rows() {
#ifdef __AVX512F__
  static constexpr MomentKernel kernel = {"AVX-512", footprints, feet_rows, plain_rows_of, add_outer};
  return __builtin_cpu_supports("avx512f") ? &kernel : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace patchlab
