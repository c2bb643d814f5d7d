// Which patches of two sets are the same surface?
//
// A pair may match where the bounds overlap and the squared Mahalanobis distance of the 2-jets, on the sum of
// both covariances and the pose's, passes the gate. The gate holds for the set: with probability `gate` no
// true pair of it is turned away, so each is held to gate^(1/n). One-to-one by the assignment of least total
// -log p, the better overlap deciding between equals. Other descriptions of one surface need no trial, for
// the jet is the same; where the normals oppose each other, b is turned over. The pairs share the error of
// the pose: they are solved together for it, pairs that contradict the others are dropped, and all is gated
// anew with what is then known of the pose, until nothing changes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/map/joint_update.h"
#include "engine/map/pair.h"

namespace patchlab {

struct AssociateOptions {
  double gate = 0.95;  // probability, in (0, 1)
  int rounds = 8;      // at most
};

struct Match {
  std::size_t a, b;       // indices
  PairDistance distance;  // at the refined pose
  double share = 0.0;     // of the smaller that the other covers
  bool flipped = false;   // b's normal points to the other side
};

struct Association {
  std::vector<Match> matches;  // by a
  UncertainPose a_from_b;      // refined by the matches
  double chi2 = 0.0;           // of all matches together with the pose: joint compatibility
  int dof = 0;
};

// Patches of a in one frame, those of b in another. Patches without a covariance on either side match
// nothing.
Association associate(std::span<const Patch> a, std::span<const Patch> b, const UncertainPose& a_from_b,
                      const AssociateOptions& options = {});

// b in the frame of a by the pose alone: its error is shared by all, and goes with the pose.
std::vector<Patch> standing_in(const Pose& a_from_b, std::span<const Patch> b);

}  // namespace patchlab
