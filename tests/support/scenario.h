// The scenario family of the calibration (engine/README.md): a random patch of any of the ten types seen by a
// Kinect, N random points of it, noisy.
#pragma once

#include <vector>

#include "engine/base/random.h"
#include "engine/fit/observation.h"
#include "engine/patch/patch.h"

namespace patchlab::test {

enum class NoiseMode {
  linear,  // Gaussian in x, y, z with the covariance at the true point, which the fit is given
  sensor,  // Gaussian in pixel and disparity; the fit is given the model, evaluated at the measured point
           // first
};

struct ScenarioOptions {
  std::size_t points = 300;
  NoiseMode noise = NoiseMode::linear;
  bool fully_visible = true;  // no part of the patch turns away from the camera
  double least_sag = 1.5;     // |kappa| d^2 / 2 of curved types over the range noise of one point
  double least_apart = 0.0;   // |kappa_x - kappa_y| d^2 / 2 over the same, d the lesser: what tells elliptic
                              // from circular
  double outliers = 0.0;      // share of points on a plane 2 to 10 cm behind one side
};

struct Scenario {
  Patch truth;                                // camera frame; z towards the camera, conventional
  double range_sigma = 0.0;                   // m, at the centre
  Vector2d region_offset = Vector2d::Zero();  // where a paraboloid's region is centred, from its vertex (m)
};

// Random d of 5 to 20 cm, curvature radius of 5 cm to 1 m with |kappa| d of 0.25 to 0.9, 0.7 to 2 m away,
// tilted by 5 to 55 degrees; concave or convex. The region of a paraboloid is centred about its vertex as the
// stated prior says: 5 % of its size; the prior's other term, 0.25/N, comes from which points are drawn.
Scenario random_scenario(Random& random, const PatchTypeRow& type, bool concave,
                         const ScenarioOptions& options);

// Fresh points of the scenario's region.
Observations observe(Random& random, const Scenario& scenario, const ScenarioOptions& options);

}  // namespace patchlab::test
