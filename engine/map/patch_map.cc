#include "engine/map/patch_map.h"

#include <algorithm>
#include <set>
#include <utility>

#include "engine/map/common_form.h"
#include "engine/map/correct.h"
#include "engine/map/enclosing.h"
#include "engine/map/weigh.h"

namespace patchlab {
namespace {

constexpr int relinearisations = 3;

// What the matches measure at one estimate of the pose.
struct Linearised {
  std::vector<Patch> stands;  // the patch that each measurement is about
  std::vector<Pose> planes;
  std::vector<Measurement> measurements;
  std::vector<const Match*> matches;
};

Patch facing(const Match& match, const Patch& b) { return match.flipped ? flip_normal(b) : b; }

Linearised linearised(const PatchMap& map, const std::vector<Patch>& view, const Pose& pose,
                      std::span<const Match> matches) {
  Linearised out;
  for (const Match& match : matches) {
    const Patch &a = map.patches[match.a].patch, b = facing(match, view[match.b]);
    const Overlap shared = overlap(sampled(a), sampled(b), 0.0);
    const Overlap at = shared.share > 0.0 ? shared : Overlap{0.0, 0.0, centre(b), axes(b).col(2)};
    const Pose plane = plane_of(a, b, at);
    const auto pair = measure_pair({a, b, pose, plane});
    if (!pair) continue;
    out.planes.push_back(plane);
    out.stands.push_back(pair->stands_a ? a : b);
    Measurement measurement = apart_from_vertex(*pair);
    const auto sights = static_cast<int>(map.patches[match.a].observations.size());
    if (pair->whole) measurement.R_gain = levelled(measurement, std::max(1, sights));
    out.measurements.push_back(std::move(measurement));
    out.matches.push_back(&match);
  }
  return out;
}

std::string free_id(const PatchMap& map, const std::string& source, const std::string& id) {
  const auto taken = [&](const std::string& name) {
    return std::ranges::count(map.patches, name, &MapPatch::id) > 0;
  };
  if (!taken(id)) return id;
  const std::string with_source = source.empty() ? id : source + "/" + id;
  std::string name = with_source;
  for (int i = 2; taken(name); ++i) name = with_source + "-" + std::to_string(i);
  return name;
}

void fuse(MapPatch& patch, const Patch& updated, const Observation& seen) {
  patch.observations.push_back(seen);
  std::vector<Patch> all;
  for (const Observation& one : patch.observations) all.push_back(one.patch);
  patch.patch = with_enclosing_bound(updated, all);
}

Eigen::Matrix<double, Eigen::Dynamic, 6> chart_by_pose(const Pose& pose, const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  const Matrix6d J_wt = J_wt_pose(pose, patch);
  Eigen::Matrix<double, Eigen::Dynamic, 6> J = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(type.size(), 6);
  J.middleRows(type.rotation_at(), type.rotation_size) = J_wt.topRows(type.rotation_size);
  J.bottomRows<3>() = J_wt.bottomRows<3>();
  return J;
}

}  // namespace

std::vector<Patch> patches_of(const PatchMap& map) {
  std::vector<Patch> out;
  for (const MapPatch& patch : map.patches) out.push_back(patch.patch);
  return out;
}

Merged merge(const PatchMap& map, const View& view, std::span<const Match> matches) {
  Merged out{map, view.map_from_view, {}};
  Linearised at;
  JointUpdate update;
  std::vector<Patch> standing;
  for (int i = 0; i < relinearisations; ++i) {
    standing = standing_in(out.map_from_view.pose, view.patches);
    at = linearised(map, standing, out.map_from_view.pose, matches);
    update = update_jointly(
        at.measurements,
        {view.map_from_view.pose.vector() - out.map_from_view.pose.vector(), view.map_from_view.covariance});
    if (i + 1 == relinearisations) break;
    const Vector6d pose = out.map_from_view.pose.vector() + update.delta.mean;
    out.map_from_view.pose = {pose.head<3>(), pose.tail<3>()};
  }
  out.map_from_view.covariance = update.delta.covariance;
  for (const MapPatch& patch : map.patches)
    out.C.push_back(Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(patch.patch.type->size(), 6));
  std::set<std::size_t> fused;
  for (std::size_t i = 0; i < at.matches.size(); ++i) {
    const Match& match = *at.matches[i];
    const Observation seen{view.sources[match.b], view.ids[match.b],  facing(match, standing[match.b]),
                           match.distance.chi2,   match.distance.dof, view.when};
    const Updated& step = update.patches[i];
    fuse(out.map.patches[match.a], corrected(at.stands[i], step.x, step.P, at.planes[i]), seen);
    out.C[match.a] = update.patches[i].C;
    fused.insert(match.b);
  }
  for (std::size_t j = 0; j < view.patches.size(); ++j) {
    if (fused.contains(j)) continue;
    const Patch added = transform(out.map_from_view, view.patches[j]);
    out.C.push_back(chart_by_pose(out.map_from_view.pose, added));
    out.map.patches.push_back({free_id(out.map, view.sources[j], view.ids[j]),
                               added,
                               {{view.sources[j], view.ids[j], standing[j], 0.0, 0, view.when}}});
  }
  return out;
}

}  // namespace patchlab
