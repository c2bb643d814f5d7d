#include "engine/map/frames.h"

#include <algorithm>
#include <set>

namespace patchlab {
namespace {

Error frame_error(const std::string& sentence) { return {ErrorCode::usage, sentence}; }

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

}  // namespace

Result<void> FrameTree::add(const std::string& child, const std::string& parent,
                            const UncertainPose& parent_from_child) {
  if (child.empty() || parent.empty()) return frame_error("A frame needs a name.");
  const auto known = links_.find(child);
  if (known != links_.end() && !known->second.parent.empty()) {
    return frame_error("Frame " + quoted(child) + " hangs in " + quoted(known->second.parent) +
                       " already; it cannot hang in " + quoted(parent) + " too.");
  }
  const std::vector<std::string> above = to_root(parent);
  if (std::ranges::find(above, child) != above.end()) {
    return frame_error("Frame " + quoted(child) + " cannot hang in " + quoted(parent) +
                       ", which hangs in it: the frames would close a loop.");
  }
  links_.try_emplace(parent);
  links_[child] = {parent, parent_from_child};
  return {};
}

bool FrameTree::has(const std::string& frame) const { return links_.contains(frame); }

std::vector<std::string> FrameTree::names() const {
  std::vector<std::string> out;
  for (const auto& [name, link] : links_) out.push_back(name);
  return out;
}

std::vector<std::string> FrameTree::to_root(const std::string& frame) const {
  std::vector<std::string> out = {frame};
  for (auto at = links_.find(frame); at != links_.end() && !at->second.parent.empty();
       at = links_.find(out.back())) {
    out.push_back(at->second.parent);
  }
  return out;
}

Result<void> FrameTree::check_known(const std::string& frame) const {
  if (has(frame)) return {};
  return frame_error("There is no frame " + quoted(frame) + "; add it, or name one of those that there are.");
}

Result<Chain> FrameTree::path(const std::string& to, const std::string& from) const {
  for (const std::string& frame : {to, from}) {
    if (const Result<void> known = check_known(frame); !known) return known.error();
  }
  std::vector<std::string> up = to_root(to), down = to_root(from);
  if (up.back() != down.back()) {
    return frame_error("Frames " + quoted(to) + " and " + quoted(from) +
                       " are not joined: no path of poses leads from one to the other.");
  }
  std::string meeting = up.back();
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    meeting = up.back();
    up.pop_back();
    down.pop_back();
  }
  up.push_back(meeting);
  up.insert(up.end(), down.rbegin(), down.rend());
  return walk(up);
}

Result<UncertainPose> FrameTree::pose(const std::string& to, const std::string& from) const {
  const Result<Chain> chain = path(to, from);
  if (!chain) return chain.error();
  return chain->empty() ? UncertainPose{} : compose(*chain);
}

Result<Chain> FrameTree::walk(const std::vector<std::string>& frames) const {
  Chain chain;
  std::set<std::string> passed;  // children of the uncertain poses
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (const Result<void> known = check_known(frames[i]); !known) return known.error();
    if (i == 0) continue;
    const std::string &a = frames[i - 1], &b = frames[i];
    const bool down = links_.at(b).parent == a;
    if (!down && links_.at(a).parent != b) {
      return frame_error("Frames " + quoted(a) + " and " + quoted(b) +
                         " are no neighbours; name the frames between them.");
    }
    const std::string& child = down ? b : a;
    const Link& link = links_.at(child);
    if (!link.parent_from_child.covariance.isZero(0.0) && !passed.insert(child).second) {
      return frame_error("The walk passes the uncertain pose of " + quoted(child) + " in " +
                         quoted(link.parent) +
                         " twice; its error would count as two independent ones, so leave the detour out.");
    }
    chain.push_back({link.parent_from_child, down ? +1 : -1});
  }
  return chain;
}

Result<Patch> patch_in(const FrameTree& frames, const std::string& to, const FramedPatch& patch) {
  const Result<Chain> chain = frames.path(to, patch.frame);
  if (!chain) return chain.error();
  return chain->empty() ? patch.patch : transform(compose(*chain), patch.patch);
}

}  // namespace patchlab
