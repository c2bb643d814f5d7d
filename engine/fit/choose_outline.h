// Step 4 by evidence: which of Table I's outlines a plane's points fill most tightly.
//
// N points that cover a shape of area A evenly have the likelihood A^-N, so the least shape of each kind
// about them is the likeliest. Its edges are known to 1/N, not to 1/sqrt(N) as regular parameters are, so the
// evidence of a kind with p parameters is -2 N ln A - 2 p ln N; the score is its negative, as BIC is of the
// surfaces.
#pragma once

#include <vector>

#include "engine/fit/fit_patch.h"
#include "engine/fit/foot_points.h"

namespace patchlab {

// Best first. Points of weight zero do not count. Precondition: the others span the plane.
std::vector<OutlineCandidate> choose_outline(const FootPoints& feet);

}  // namespace patchlab
