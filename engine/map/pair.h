// Two patches that may be the same surface: how far apart they are in standard deviations, and what each says
// about the other.
#pragma once

#include <optional>

#include "engine/map/joint_update.h"
#include "engine/map/overlap.h"
#include "engine/patch/patch.h"

namespace patchlab {

// b stands in the frame of a by the pose a_from_b, whose error both know nothing else about.
struct Pair {
  const Patch& a;
  const Patch& b;
  const Pose& a_from_b;
  Pose plane;  // at the middle of their overlap, z along their normals (`plane_of`)
};
Pose plane_of(const Patch& a, const Patch& b, const Overlap& overlap);

struct PairDistance {
  double chi2 = 0.0;  // squared Mahalanobis distance of the 2-jets, by the sum of the covariances
  int dof = 0;        // directions that the two types can differ in
  double p_value = 0.0;
};
// Nothing where the two share no sheet at the plane, or neither has a covariance.
std::optional<PairDistance> pair_distance(const Pair& pair, const Matrix6d& cov_pose);

// What one patch says about the other. Of one type, all of the surface; of two, the 2-jet at the overlap, and
// the richer type stands. Nothing where neither has a covariance, or where the 2-jet is asked for and
// missing.
struct PairMeasurement {
  bool stands_a = true;  // the patch that is updated: a, or else b
  bool whole = true;     // of one type: all of the surface
  Measurement measurement;
  Eigen::MatrixXd cov_y_vertex;  // of y and where the other patch's vertex is by its prior; often no columns
  PatchMatrix P_at_vertex;       // what P is where the vertex of the patch that stands is known
};
std::optional<PairMeasurement> measure_pair(const Pair& pair);

// What of it is new to a surface that stands. Points hardly tell where the vertex of a paraboloid is: each
// fit puts it where its own patch is centred (method M4). Sights of one place err alike in that, so it may
// count once only. What is left are the combinations of y that the other patch's vertex does not reach: all
// that its points said, but for the little that they said of the vertex. Nor does the surface that stands
// learn where its own vertex is, for where two err alike it tells nothing that they agree. A vertex that is
// known far better than that prior says is not by the prior, and counts in full.
Measurement apart_from_vertex(const PairMeasurement& pair);

}  // namespace patchlab
