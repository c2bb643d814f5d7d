#include "engine/project/map_commands.h"
#include "engine/project/parts_json.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

Matrix6d read_covariance(const JsonPlace& place) { return place.covariance(6); }

double read_sigma(const JsonPlace& place) {
  const double sigma = place.number();
  must(sigma >= 0.0, place, "must not be negative");
  return sigma;
}

double read_gate(const JsonPlace& place) {
  const double gate = place.number();
  must(gate > 0.0 && gate < 1.0, place, "must be between 0 and 1");
  return gate;
}

std::vector<std::array<std::string, 2>> read_pairs(const JsonPlace& place) {
  std::vector<std::array<std::string, 2>> pairs;
  for (const JsonPlace& item : place.items()) {
    const std::vector<JsonPlace> ids = item.items();
    must(ids.size() == 2, item, "must be two ids: of the map and of what is merged");
    if (ids.size() == 2) pairs.push_back({ids[0].text(), ids[1].text()});
  }
  return pairs;
}

struct NamedFile {
  const char *name, *hash_name;
  std::string OpenRobot::*file;
  std::string OpenRobot::*hash;
};
constexpr NamedFile further_files[] = {
    {"joints", "joints_sha256", &OpenRobot::joints, &OpenRobot::joints_sha256},
    {"patches", "patches_sha256", &OpenRobot::patches, &OpenRobot::patches_sha256}};

}  // namespace

void read(const JsonPlace& place, OpenMap& open) {
  place.only({"do", "id", "file", "sha256"});
  open.id = place["id"].text();
  open.file = place["file"].text();
  may(place, "sha256", open.sha256, &JsonPlace::text);
}

ordered_json write(const OpenMap& open) {
  ordered_json object = {{"do", "open_map"}, {"id", open.id}, {"file", open.file}};
  if (!open.sha256.empty()) object["sha256"] = open.sha256;
  return object;
}

void read(const JsonPlace& place, OpenRobot& open) {
  place.only({"do", "id", "file", "sha256", "joints", "joints_sha256", "patches", "patches_sha256"});
  open.id = place["id"].text();
  open.file = place["file"].text();
  may(place, "sha256", open.sha256, &JsonPlace::text);
  for (const auto& [name, hash_name, file, hash] : further_files) {
    may(place, name, open.*file, &JsonPlace::text);
    may(place, hash_name, open.*hash, &JsonPlace::text);
  }
}

ordered_json write(const OpenRobot& open) {
  ordered_json object = {{"do", "open_robot"}, {"id", open.id}, {"file", open.file}};
  if (!open.sha256.empty()) object["sha256"] = open.sha256;
  for (const auto& [name, hash_name, file, hash] : further_files) {
    if (!(open.*file).empty()) object[name] = open.*file;
    if (!(open.*hash).empty()) object[hash_name] = open.*hash;
  }
  return object;
}

void read(const JsonPlace& place, SetJoint& set) {
  place.only({"do", "robot", "joint", "value", "sigma"});
  set.robot = place["robot"].text();
  set.joint = place["joint"].text();
  set.value = place["value"].number();
  may(place, "sigma", set.sigma, read_sigma);
}

ordered_json write(const SetJoint& set) {
  ordered_json object = {
      {"do", "set_joint"}, {"robot", set.robot}, {"joint", set.joint}, {"value", set.value}};
  if (set.sigma) object["sigma"] = *set.sigma;
  return object;
}

void read(const JsonPlace& place, Place& put) {
  place.only({"do", "frame", "in", "r", "t", "covariance"});
  put.frame = place["frame"].text();
  put.in = place["in"].text();
  put.pose.pose = {read_position(place["r"]), read_position(place["t"])};
  may(place, "covariance", put.pose.covariance, read_covariance);
}

ordered_json write(const Place& put) {
  ordered_json object = {{"do", "place"},
                         {"frame", put.frame},
                         {"in", put.in},
                         {"r", list(put.pose.pose.r)},
                         {"t", list(put.pose.pose.t)}};
  if (put.pose.covariance.isZero(0.0)) return object;
  ordered_json& rows = object["covariance"] = ordered_json::array();
  for (const auto& row : put.pose.covariance.rowwise()) {
    rows.push_back(ordered_json::array());
    for (const double value : row) rows.back().push_back(value);
  }
  return object;
}

void read(const JsonPlace& place, Merge& merge) {
  place.only({"do", "map", "view", "gate", "refused", "when"});
  merge.map = place["map"].text();
  merge.view = place["view"].text();
  may(place, "gate", merge.gate, read_gate);
  may(place, "refused", merge.refused, read_pairs);
  may(place, "when", merge.when, &JsonPlace::text);
}

ordered_json write(const Merge& merge) {
  ordered_json object = {{"do", "merge"}, {"map", merge.map}, {"view", merge.view}, {"gate", merge.gate}};
  if (!merge.refused.empty()) object["refused"] = merge.refused;
  if (!merge.when.empty()) object["when"] = merge.when;
  return object;
}

}  // namespace patchlab
