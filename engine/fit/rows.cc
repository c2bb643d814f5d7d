#include "engine/fit/rows.h"

namespace patchlab {
namespace {

const RowKernel& fastest() {
  if (const RowKernel* kernel = avx512_rows()) return *kernel;
  if (const RowKernel* kernel = avx2_rows()) return *kernel;
  return plain_rows();
}

}  // namespace

const RowKernel& fastest_rows() {
  static const RowKernel& kernel = fastest();
  return kernel;
}

}  // namespace patchlab
