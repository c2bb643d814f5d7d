#include <cmath>
#include <cstdio>
#include <memory>

#include "engine/base/chi_square.h"
#include "engine/cli/map_files.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/io/map_set.h"

namespace patchlab {
namespace {

struct MergeRequest {
  std::string a, b, pose, when;
  double gate = 0.95;
  std::string output = "-";
  bool json = false;
};

std::string sentence(const Match& match, const PatchMap& map, const View& view) {
  char numbers[120];
  std::snprintf(numbers, sizeof numbers, ": distance %.2f (chi2 %.2f of %d, p %.3f), overlap %.0f %%",
                std::sqrt(match.distance.chi2), match.distance.chi2, match.distance.dof,
                match.distance.p_value, 100.0 * match.share);
  return map.patches[match.a].id + " = " + view.ids[match.b] + numbers;
}

void report(const Association& found, const PatchMap& map, const View& view) {
  for (const Match& match : found.matches) say(sentence(match, map, view));
  const std::size_t matched = found.matches.size();
  say(std::to_string(matched) + " of " + std::to_string(view.patches.size()) +
      " patches matched and fused, " + std::to_string(view.patches.size() - matched) + " added.");
  if (found.dof > 0 && chi_square_p_value(found.chi2, found.dof) < 1e-3) {
    say("Together the matches contradict the pose (chi2 " + std::to_string(found.chi2) + " of " +
        std::to_string(found.dof) + "): look at its covariance.");
  }
}

Result<int> merge_sets(const MergeRequest& request) {
  const Result<PatchSet> set_a = read_set(request.a);
  if (!set_a) return set_a.error();
  Result<PatchSet> set_b = read_set(request.b);
  if (!set_b) return set_b.error();
  rename_sources(*set_a, *set_b);
  const Result<PatchMap> a = map_of(*set_a, called(request.a)), b = map_of(*set_b, called(request.b));
  if (!a) return a.error();
  if (!b) return b.error();
  const Result<UncertainPose> pose = pose_between(request.pose, {request.a, *a}, {request.b, *b});
  if (!pose) return pose.error();
  PatchMap map = *a;
  if (map.frame.empty()) map.frame = b->frame;
  const Result<void> unseen = check_unseen(map, *set_b, called(request.a), called(request.b));
  if (!unseen) return unseen.error();
  View view = view_of(*set_b, *pose);
  view.when = request.when;
  const Association found = associate(patches_of(map), view.patches, *pose, {.gate = request.gate});
  report(found, map, view);
  PatchSet merged = set_of(merge(map, view, found.matches).map, *set_a, *set_b);
  if (!pose->covariance.isZero(0.0)) state_shared_errors(merged);
  const Result<std::string> text = write_patch_set(merged);
  if (!text) return text.error();
  Outputs outputs;
  outputs.add(request.output, *text);
  return outputs.write();
}

}  // namespace

Action set_up_map_merge(CLI::App& app) {
  const auto request = std::make_shared<MergeRequest>();
  app.add_option("a", request->a, "the map: a patch set, or what an earlier merge wrote")->required();
  app.add_option("b", request->b, "the patch set to merge into it")->required();
  app.add_option(
      "--pose", request->pose,
      "pose of B's frame in A's: what map chain takes, or what it prints; without it both are in one frame");
  app.add_option("--gate", request->gate, "probability that no true pair is turned away")
      ->check(CLI::Range(1e-6, 1.0 - 1e-6))
      ->capture_default_str();
  app.add_option("--when", request->when,
                 "kept with what B adds: when it was seen, 2026-11-23T14:02:11Z say");
  app.add_option("-o,--output", request->output, "where to write the map; standard output without it");
  app.add_flag("--json", request->json, "print JSON, which it does anyway");
  return [request] { return merge_sets(*request); };
}

}  // namespace patchlab
