#include "engine/fit/moment_rows.h"

namespace patchlab {
namespace {

const MomentKernel& fastest_of_all() {
  if (const MomentKernel* kernel = avx512_moment_rows()) return *kernel;
  if (const MomentKernel* kernel = avx2_moment_rows()) return *kernel;
  return plain_moment_rows();
}

}  // namespace

const MomentKernel& fastest_moment_rows() {
  static const MomentKernel& kernel = fastest_of_all();
  return kernel;
}

}  // namespace patchlab
