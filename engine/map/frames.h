// Named frames joined by uncertain poses: a tree, or several. Every scan, patch and robot hangs in one of its
// frames.
//
// A pose is found by the one path that joins two frames, composed by Eqs. (9), (10), (42). A path of a tree
// passes no pose twice, and what two frames share on their way to the root drops out of their relation. A
// walk that a caller spells out may pass one twice; Eq. (42) does not cover that (errata section 7), so it is
// refused.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/patch/patch.h"
#include "engine/pose/chain.h"

namespace patchlab {

class FrameTree {
 public:
  // Hangs `child` in `parent` (which may be new). usage error where child hangs in a frame already, or where
  // the two would close a loop.
  Result<void> add(const std::string& child, const std::string& parent,
                   const UncertainPose& parent_from_child);

  bool has(const std::string& frame) const;
  std::vector<std::string> names() const;  // in alphabetical order

  // The chain of to_from_from by the shortest path. usage error where a frame is unknown or the two are not
  // joined.
  Result<Chain> path(const std::string& to, const std::string& from) const;
  Result<UncertainPose> pose(const std::string& to, const std::string& from) const;

  // The chain along a walk of frames, from the base to the end; neighbours in the list are parent and child.
  // usage error where they are not, or where the walk passes an uncertain pose twice.
  Result<Chain> walk(const std::vector<std::string>& frames) const;

 private:
  struct Link {
    std::string parent;
    UncertainPose parent_from_child;
  };
  std::vector<std::string> to_root(const std::string& frame) const;  // the frame itself first
  Result<void> check_known(const std::string& frame) const;

  std::map<std::string, Link> links_;  // of every frame; a root has no parent ("")
};

// A patch in the frame where it was measured. It stays there: seen from another frame it is computed anew
// from there, so that no pose enters its covariance twice, and there and back is the patch itself.
struct FramedPatch {
  Patch patch;
  std::string frame;
};
Result<Patch> patch_in(const FrameTree& frames, const std::string& to, const FramedPatch& patch);

}  // namespace patchlab
