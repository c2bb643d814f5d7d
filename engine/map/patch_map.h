// The patch map, Section V: the surfaces around a robot in one frame, each with what was seen of it and when.
// A value: an update gives a new map, and the old one is its undoing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/map/associate.h"
#include "engine/patch/patch.h"

namespace patchlab {

// One sight of a surface, in the map's frame as it was estimated then.
struct Observation {
  std::string source;  // the scan or file
  std::string id;      // of the patch there
  Patch patch;         // with its own covariance
  double chi2 = 0.0;   // squared distance to the map's patch; zero for the first
  int dof = 0;
  std::string when = {};  // as the view says
};

struct MapPatch {
  std::string id;  // stable
  Patch patch;     // fused; its bound is derived from the observations where there are several
  std::vector<Observation> observations;
};

struct PatchMap {
  std::string frame;
  std::vector<MapPatch> patches;
};

// A set of patches in a frame of their own.
struct View {
  std::vector<std::string> sources, ids;  // of each patch: its scan or file, its id there
  std::vector<Patch> patches;
  UncertainPose map_from_view;
  std::string when = {};  // it was seen: a date and time, say; empty where nobody says
};

struct Merged {
  PatchMap map;
  UncertainPose map_from_view;  // refined by the matches
  // The error of the pose is in every patch that the view updated or added: the covariance of patches i and j
  // of the map is C_i cov_pose C_j' (C: rows of the local chart of the patch that the view met, or of the
  // added one; zero where the view says nothing).
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, 6>> C;
};

std::vector<Patch> patches_of(const PatchMap& map);

// The view's patches brought into the map: the matches (a: map, b: view) fused by one joint Kalman update
// with the pose, the others added. Patches without covariance are added as they are. Between merges the
// patches count as independent: C of one merge is not carried into the next.
Merged merge(const PatchMap& map, const View& view, std::span<const Match> matches);

}  // namespace patchlab
