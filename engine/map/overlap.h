// Where two patches in one frame cover each other. Bounds tell of overlap, not of identity.
#pragma once

#include <vector>

#include "engine/patch/patch.h"

namespace patchlab {

// A patch with points spread over it, in the frame of the patch.
struct SampledPatch {
  Patch patch;
  std::vector<Vector3d> points, normals;
  Vector3d middle;      // of the points
  double radius = 0.0;  // of the ball about the middle that holds the points
};
SampledPatch sampled(const Patch& patch);
SampledPatch turned_over(const SampledPatch& patch);  // by flip_normal

struct Overlap {
  double share = 0.0;    // of the smaller patch that the other covers, in [0, 1]
  double jaccard = 0.0;  // shared area over the area of both together, in [0, 1]
  Vector3d point = Vector3d::Zero(), normal = Vector3d::UnitZ();  // mean over what both cover
};
// `margin` (m): the bounds are that much wider. Patches that face away from each other do not overlap.
Overlap overlap(const SampledPatch& a, const SampledPatch& b, double margin);

// The boundary with every length grown by `margin` >= 0.
Boundary grown(const Boundary& boundary, double margin);

}  // namespace patchlab
