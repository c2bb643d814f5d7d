// Normal equations that may leave some direction open.
#pragma once

#include "engine/fit/cholesky.h"

namespace patchlab {

// The least x with A x = b. Precondition: A symmetric and positive semidefinite, b in its range.
StepVector solve_least(const StepMatrix& A, const StepVector& b);

}  // namespace patchlab
