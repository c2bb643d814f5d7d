// Questions to patches, with the standard deviation of every answer. Patches stand in one frame with
// independent errors; to ask about two in different frames bring one into the other's with `patch_in`
// (engine/map/frames.h), so that poses which both share drop out.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/patch/patch.h"

namespace patchlab {

struct Estimate {
  double value = 0.0, sigma = 0.0;
};

// Between the centres, m.
Estimate centre_distance(const Patch& a, const Patch& b);
// Between the outward normals at the centres, rad in [0, pi]. Where the normals are (anti)parallel the angle
// has no derivative; sigma is then that of the worst direction.
Estimate normal_angle(const Patch& a, const Patch& b);

// Angle between the outward normal and `up` (against gravity), rad.
Estimate tilt(const Patch& patch, const Vector3d& up);
// Probability that it exceeds `limit` (rad, in (0, pi)): over the normal distribution of the tilt in both
// directions, so it holds for level patches too.
double tilt_exceeds(const Patch& patch, const Vector3d& up, double limit);

// A foot patch over a ground patch: its outward normal towards the ground. Clearances are from points of the
// foot to the nearest of the ground's surface, m, negative inside it.
struct FootFit {
  Estimate gap;        // the least clearance: how far the foot is from touching
  Estimate rocking;    // greatest less least: how badly the two shapes match
  double share = 0.0;  // of the foot that the ground's bounds hold, in [0, 1]
};
FootFit foot_fit(const Patch& foot, const Patch& ground);

// The distance from a point to a bounded patch, m (to the points of its outline where the surface's nearest
// point lies outside, accurate to a hundredth of the outline).
double distance_to(const Patch& patch, const Vector3d& point);
struct NearPatch {
  std::size_t index;
  double distance;  // m
};
// Those within `radius` of the point, nearest first.
std::vector<NearPatch> patches_within(std::span<const Patch> patches, const Vector3d& point, double radius);

}  // namespace patchlab
