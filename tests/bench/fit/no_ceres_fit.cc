#include "tests/bench/fit/solvers.h"

namespace patchlab::bench {

bool has_ceres() { return false; }
Solved ceres(Ceres, const Samples&, const Objective&, const SurfaceState&) { return {}; }

}  // namespace patchlab::bench
