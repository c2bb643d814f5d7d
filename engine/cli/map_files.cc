#include "engine/cli/map_files.h"

#include "engine/base/file.h"
#include "engine/cli/chain_file.h"

namespace patchlab {

std::string called(const std::string& file) { return file == "-" ? "standard input" : file; }

Result<PatchSet> read_set(const std::string& file) {
  const Result<Bytes> bytes = read_file(file);
  if (!bytes) return bytes.error();
  return read_patch_set(as_text(*bytes), called(file));
}

Result<UncertainPose> pose_between(const std::string& pose, const MapFile& a, const MapFile& b) {
  if (pose.empty()) {
    if (a.map.frame == b.map.frame || a.map.patches.empty() || b.map.patches.empty()) return UncertainPose{};
    return Error{ErrorCode::usage, called(b.file) + ": its patches stand in frame \"" + b.map.frame +
                                       "\", those of " + called(a.file) + " in \"" + a.map.frame +
                                       "\"; give the pose between them with --pose."};
  }
  const Result<Bytes> bytes = read_file(pose);
  if (!bytes) return bytes.error();
  const Result<Chain> chain = parse_pose(as_text(*bytes), called(pose));
  if (!chain) return chain.error();
  return compose(*chain);
}

}  // namespace patchlab
