#include "engine/scan/window_planes_kernel.h"

namespace patchlab {

const WindowKernel& plain_windows() {
  static constexpr WindowKernel kernel = {"plain", normals_of_rows};
  return kernel;
}

const WindowKernel& fastest_windows() {
  static const WindowKernel* const avx2 = avx2_windows();
  return avx2 != nullptr ? *avx2 : plain_windows();
}

}  // namespace patchlab
