#include "engine/fit/rows.h"

namespace patchlab {

const RowKernel& fastest_rows() {
  static const RowKernel* const avx2 = avx2_rows();
  return avx2 != nullptr ? *avx2 : plain_rows();
}

}  // namespace patchlab
