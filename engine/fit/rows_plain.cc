#include "engine/fit/rows_kernel.h"

namespace patchlab {

const RowKernel& plain_rows() {
  static constexpr RowKernel kernel = {"plain", paper_rows, exact_rows, height_rows, add_rows};
  return kernel;
}

}  // namespace patchlab
