// Steps 1 to 3 as the paper prints them, with the errata that make them computable (errata F):
// for reproduction and comparison. Equations (33)-(36) with the residual at the measured point, starts from
// kappa = 0, a free vertex for paraboloids, no refit after a curvature is dropped.
#pragma once

#include "engine/fit/steps.h"

namespace patchlab {

void paper_plane(Workbench& work);     // step 1
void paper_surfaces(Workbench& work);  // step 2
void paper_type(Workbench& work);      // step 3

}  // namespace patchlab
