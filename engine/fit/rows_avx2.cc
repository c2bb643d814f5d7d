#include "engine/fit/rows_kernel.h"

namespace patchlab {

const RowKernel* avx2_rows() {
#if defined(__AVX2__) && defined(__FMA__)
  static constexpr RowKernel kernel = {"AVX2", paper_rows, exact_rows, height_rows, add_rows};
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &kernel : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace patchlab
