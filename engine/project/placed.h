// The patches of a document where they stand: fitted to scans, in maps, on robots.
//
// Everything is shown in one frame, that of the first scan, or else map, or else robot. Frames that no Place
// joins to it are taken to be it, in pictures alone: questions and merges ask for the pose.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/map/associate.h"
#include "engine/map/frames.h"
#include "engine/map/queries.h"
#include "engine/project/document.h"

namespace patchlab {

std::string shown_frame(const Document& document);
// Against gravity in it: +z; of the frame of a sensor -y, as cameras are held.
struct UpDirection {
  Vector3d direction;
  const char* axis;  // "+z"
};
UpDirection up_in(const std::string& frame);
// Of scans, maps, robots and what was placed, each once.
std::vector<std::string> frame_names(const Document& document);
FrameTree frame_tree(const Document& document);
// to_from_from. usage error, saying what to do, where the two are not joined.
Result<UncertainPose> pose_between(const Document& document, const std::string& to, const std::string& from);
// shown_from_frame; the identity where it is not joined.
UncertainPose standing(const Document& document, const std::string& frame);

enum class PatchOf { scan, map, robot };
struct PlacedPatch {
  std::string id;  // "patch-2", "map-1/patch-3", "robot-1/left_sole"
  std::string name;
  PatchOf of = PatchOf::scan;
  std::string owner;  // id of the scan, map or robot
  std::string frame;  // that `patch` stands in: of a robot the link
  Patch patch;
};
// Each in its own frame; those of robots as they were designed on their links.
std::vector<PlacedPatch> placed_patches(const Document& document);
std::optional<PlacedPatch> find_placed(const Document& document, const std::string& id);

bool is_visible(const Document& document, const PlacedPatch& patch);

// A robot as it stands; usage error as PosedRobot::make.
Result<PosedRobot> posed(const RobotEntry& robot);
// The patch in the frame that everything is shown in, with what joints and poses add to its covariance. Scans
// and their patches are shown where their points are.
Result<Patch> as_shown(const Document& document, const PlacedPatch& patch);

// Two patches in one frame in which their errors are independent: what both share on the way drops out.
Result<std::array<Patch, 2>> related(const Document& document, const std::string& a, const std::string& b);
struct Relation {
  Estimate distance, angle;  // of the centres, m; of the normals, rad
  FootFit foot;              // a over b, or b over a where b is the robot's
};
Result<Relation> relate(const Document& document, const std::string& a, const std::string& b);
struct Slope {
  Estimate tilt;         // rad
  double exceeds = 0.0;  // probability that it exceeds the limit
};
Result<Slope> slope(const Document& document, const std::string& id, const Vector3d& up, double limit);

// What to write of a document where `chosen` is its entry or patch in focus: a map, where it is one or of
// one, or nothing is fitted to a scan; else the patches that are.
PatchSet set_to_export(const Document& document, const std::string& chosen, const std::string& journal);

// What a merge would match, before anything is refused.
struct MergeProposal {
  PatchMap map;
  PatchSet set, added;  // behind the map, behind the view
  View view;
  Association found;
};
// As Merge of engine/project/command.h. usage error for unknown ids, frames that are not joined, and sights
// that the map holds already.
Result<MergeProposal> propose_merge(const Document& document, const std::string& map, const std::string& view,
                                    double gate);

}  // namespace patchlab
