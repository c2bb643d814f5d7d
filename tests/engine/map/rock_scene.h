// Simulated views of a field of rocks and ground: patches with covariances, their errors drawn from them,
// seen from two frames whose relation is known with noise.
#pragma once

#include <vector>

#include "engine/base/random.h"
#include "engine/map/associate.h"
#include "engine/patch/patch.h"
#include "tests/engine/patch/example_patches.h"

namespace patchlab::test {

struct RockScene {
  std::vector<Patch> truth;  // in the map's frame
};
// Rocks of every type on a grid with jitter, an ever shifting quarter of the places bare ground of one
// height.
RockScene rock_scene(Random& random, int count);

// A random shape of a kind without covariance, its two curvatures told apart by more than their noise (the
// fit of a surface that bends alike in x and y knows no x).
Patch rock_shape(Random& random, const PatchCase& kind);

struct RockView {
  std::vector<Patch> patches;       // in the view's frame, with errors and covariances
  std::vector<std::size_t> truths;  // index of each in the scene
  UncertainPose map_from_view;      // as estimated
  Pose true_map_from_view;
};
// A view of the truths in `seen`. Bounds differ from view to view; planes, spheres and cylinders slide in
// themselves. `exact_pose`: the pose is known without error.
RockView rock_view(Random& random, const RockScene& scene, const std::vector<std::size_t>& seen,
                   bool exact_pose = false);

// Two views of a scene, 30 % of its patches in one of them only; the first stands in the map's frame.
struct TwoViews {
  RockView a, b;
};
TwoViews two_views(Random& random, int count);

// One error of `covariance`.
Eigen::VectorXd draw(Random& random, const Eigen::MatrixXd& covariance);

// Who is right: pairs of indices that see one truth.
struct Score {
  int right = 0, wrong = 0, possible = 0;
  double precision() const { return right + wrong == 0 ? 1.0 : static_cast<double>(right) / (right + wrong); }
  double recall() const { return possible == 0 ? 1.0 : static_cast<double>(right) / possible; }
};
Score& operator+=(Score& sum, const Score& one);
Score score(const std::vector<Match>& matches, const RockView& a, const RockView& b);

}  // namespace patchlab::test
