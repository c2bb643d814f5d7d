#include "engine/fit/moment_rows_kernel.h"

namespace patchlab {

const MomentKernel& plain_moment_rows() {
  static constexpr MomentKernel kernel = {"plain", footprints, feet_rows, plain_rows_of, add_outer};
  return kernel;
}

}  // namespace patchlab
