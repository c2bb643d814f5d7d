#include "engine/fit/rows_kernel.h"

namespace patchlab {

const RowKernel* avx512_rows() {
#ifdef __AVX512F__
  static constexpr RowKernel kernel = {"AVX-512", paper_rows, exact_rows, height_rows, add_rows};
  return __builtin_cpu_supports("avx512f") ? &kernel : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace patchlab
