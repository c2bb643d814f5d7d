// Step 2 for all candidates where some points belong to something else (method M12).
#pragma once

#include <vector>

#include "engine/fit/fit_model.h"

namespace patchlab {

struct RobustFits {
  std::vector<SurfaceFit> fits;  // one a candidate, all at the same scale, so that their costs compare
  double scale;                  // what counted as a standard deviation, in those of the noise model
};

// Tukey's fits over all points, each from the fit of those that have a robust weight; the weights are 1 for
// all after it. The scale is robust_scale() of the 2-jet.
RobustFits fit_models_robustly(Samples& samples, const std::vector<ModelKind>& kinds,
                               const ModelStart& start);

// The same where the noise model says too little for half of the points to lie on any quadric: from the
// points that have a weight and from all of them, at a scale that starts with the median residual and falls
// while the residuals do, never below 1, over a few thousand of them. What falls lower is kept; all are
// fitted again at the least scale.
RobustFits fit_models_falling(Samples& samples, const std::vector<ModelKind>& kinds, const ModelStart& start);

}  // namespace patchlab
