#include "engine/scan/window_planes_kernel.h"

namespace patchlab {

const WindowKernel* avx2_windows() {
#ifdef __AVX2__
  static constexpr WindowKernel kernel = {"AVX2", normals_of_rows};
  return __builtin_cpu_supports("avx2") ? &kernel : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace patchlab
