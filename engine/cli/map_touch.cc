#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "engine/cli/map_files.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/io/map_set.h"
#include "engine/map/touch.h"

namespace patchlab {
namespace {

struct TouchRequest {
  std::string map, patch, foot, id, pose, when;
  std::vector<double> point;
  double sigma = 0.0;  // m
  double gate = 0.999;
  std::string output = "-";
  bool json = false;
};

Error mistake(std::string message) { return {ErrorCode::usage, std::move(message)}; }

template <class Records>
auto find_in(Records& records, const std::string& id, const std::string& file)
    -> Result<decltype(&*records.begin())> {
  std::string ids;
  for (auto& record : records) {
    if (record.id == id) return &record;
    ids += " " + record.id;
  }
  return mistake(called(file) + ": no patch is called \"" + id + "\"; there are:" + ids + ".");
}

// What touched, for the file: a point and its sigma, or where a patch of the foot was found.
struct Contact {
  Result<Touched> touched;
  nlohmann::ordered_json said;
};

Result<Contact> by_point(const TouchRequest& request, const Patch& patch) {
  if (!(request.sigma > 0.0)) return mistake("A contact at a point needs --sigma, in metre.");
  const Vector3d point(request.point[0], request.point[1], request.point[2]);
  return Contact{touched_at(patch, point, request.sigma * request.sigma * Matrix3d::Identity()),
                 {{"point", request.point}, {"sigma", request.sigma}}};
}

Result<Contact> by_foot(const TouchRequest& request, const PatchMap& map, const Patch& patch) {
  const Result<PatchSet> set = read_set(request.foot);
  if (!set) return set.error();
  const Result<PatchMap> feet = map_of(*set, called(request.foot));
  if (!feet) return feet.error();
  const auto foot = find_in(feet->patches, request.id, request.foot);
  if (!foot) return foot.error();
  const Result<UncertainPose> pose = pose_between(request.pose, {request.map, map}, {request.foot, *feet});
  if (!pose) return pose.error();
  const Patch contact = transform(*pose, (*foot)->patch);
  const Vector3d c = centre(contact);
  return Contact{touched_by(patch, contact), {{"foot", request.id}, {"point", {c.x(), c.y(), c.z()}}}};
}

Result<Contact> contact_of(const TouchRequest& request, const PatchMap& map, const Patch& patch) {
  const bool point = !request.point.empty();
  if (point == !request.foot.empty()) return mistake("What touched it? Give --point and --sigma, or --foot.");
  if (!request.foot.empty() && request.id.empty())
    return mistake("Which patch of --foot touched? Give --id.");
  return point ? by_point(request, patch) : by_foot(request, map, patch);
}

std::string numbers(const Touched& touched) {
  char text[100];
  std::snprintf(text, sizeof text, "distance %.2f (chi2 %.2f of %d, p %.3g)", std::sqrt(touched.chi2),
                touched.chi2, touched.dof, touched.p_value);
  return text;
}

// The contact stands beside the observations: it has no outline.
Result<void> note(PatchSet& set, const TouchRequest& request, nlohmann::ordered_json said,
                  const Touched& touched) {
  said["chi2"] = touched.chi2;
  said["dof"] = touched.dof;
  if (!request.when.empty()) said["when"] = request.when;
  const auto record = std::ranges::find(set.patches, request.patch, &PatchRecord::id);
  auto& touches = record->unknown["touches"];
  if (!touches.is_null() && !touches.is_array()) {
    return Error{ErrorCode::unreadable, called(request.map) + ": patch \"" + request.patch +
                                            "\": \"touches\" is no list; remove it from the file."};
  }
  touches.push_back(nlohmann::json(std::move(said)));
  return {};
}

Result<int> touch(const TouchRequest& request) {
  const Result<PatchSet> set = read_set(request.map);
  if (!set) return set.error();
  Result<PatchMap> map = map_of(*set, called(request.map));
  if (!map) return map.error();
  const auto found = find_in(map->patches, request.patch, request.map);
  if (!found) return found.error();
  const Result<Contact> contact = contact_of(request, *map, (*found)->patch);
  if (!contact) return contact.error();
  const Result<Touched>& touched = contact->touched;
  if (!touched) return mistake("Patch \"" + request.patch + "\": " + touched.error().message);
  if (touched->p_value < 1.0 - request.gate) {
    return Error{ErrorCode::refused, "The contact contradicts patch \"" + request.patch +
                                         "\": " + numbers(*touched) +
                                         "; look at the joints and the pose, or raise --gate."};
  }
  say(request.patch + " touched: " + numbers(*touched));
  (*found)->patch = touched->patch;
  PatchSet out = set_of(*map, *set, {});
  if (const Result<void> noted = note(out, request, contact->said, *touched); !noted) return noted.error();
  const Result<std::string> text = write_patch_set(out);
  if (!text) return text.error();
  Outputs outputs;
  outputs.add(request.output, *text);
  return outputs.write();
}

}  // namespace

Action set_up_map_touch(CLI::App& app) {
  const auto request = std::make_shared<TouchRequest>();
  app.add_option("map", request->map, "the map: a patch set, or what map merge wrote")->required();
  app.add_option("--patch", request->patch, "the patch of the map that was touched")->required();
  app.add_option("--point", request->point, "X,Y,Z in metre: a point of contact, in the frame of the map")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--sigma", request->sigma, "of --point in each direction, in metre")
      ->check(CLI::PositiveNumber);
  app.add_option("--foot", request->foot,
                 "a patch set that holds the sole in contact, a plane: as map robot puts it");
  app.add_option("--id", request->id, "of the patch of --foot");
  app.add_option("--pose", request->pose, "pose of the frame of --foot in the map's, as in map merge");
  app.add_option("--gate", request->gate, "probability that no true contact is turned away")
      ->check(CLI::Range(1e-6, 1.0 - 1e-12))
      ->capture_default_str();
  app.add_option("--when", request->when, "kept with the contact: when it was, 2026-11-23T14:02:11Z say");
  app.add_option("-o,--output", request->output, "where to write the map; standard output without it");
  app.add_flag("--json", request->json, "print JSON, which it does anyway");
  return [request] { return touch(*request); };
}

}  // namespace patchlab
