#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

#include "engine/base/file.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/io/json.h"
#include "engine/io/patch_set.h"
#include "engine/map/queries.h"

namespace patchlab {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct QueryRequest {
  std::vector<std::string> files, between, foot;
  std::string tilt;
  std::vector<double> up = {0.0, 0.0, 1.0}, near;
  std::optional<double> limit;  // degrees
  double radius = 1.0;          // m
  bool json = false;
};

struct Answer {
  std::string words;
  nlohmann::ordered_json json;
};

// Every patch of the files, by its id.
struct Asked {
  std::vector<PatchRecord> records;
  std::vector<std::string> files;    // where each stands
  std::vector<std::string> sharing;  // files whose patches share errors
};

Result<Asked> read_all(const std::vector<std::string>& files) {
  Asked asked;
  for (const std::string& file : files) {
    const Result<Bytes> bytes = read_file(file);
    if (!bytes) return bytes.error();
    const std::string called = file == "-" ? "standard input" : file;
    const Result<PatchSet> set = read_patch_set(as_text(*bytes), called);
    if (!set) return set.error();
    if (set->unknown.contains("correlations")) asked.sharing.push_back(called);
    for (const PatchRecord& record : set->patches) {
      asked.records.push_back(record);
      asked.files.push_back(called);
    }
  }
  return asked;
}

Result<const PatchRecord*> find(const Asked& asked, const std::string& id) {
  const PatchRecord* found = nullptr;
  std::string where;
  for (std::size_t i = 0; i < asked.records.size(); ++i) {
    if (asked.records[i].id != id) continue;
    if (found) {
      return Error{ErrorCode::usage, "Patch \"" + id + "\" is in " + where + " and in " + asked.files[i] +
                                         "; rename one, so that it is clear which is meant."};
    }
    found = &asked.records[i];
    where = asked.files[i];
  }
  if (found) return found;
  std::string ids;
  for (const PatchRecord& record : asked.records) ids += " " + record.id;
  return Error{ErrorCode::usage, "No patch is called \"" + id + "\"; there are:" + ids + "."};
}

struct Two {
  const PatchRecord *a, *b;
};

Error in_two_frames(const PatchRecord& a, const PatchRecord& b) {
  return {ErrorCode::usage, "Patch \"" + a.id + "\" stands in frame \"" + a.frame_id + "\", \"" + b.id +
                                "\" in \"" + b.frame_id +
                                "\"; bring them into one with map merge --pose, or map robot --frame."};
}

Result<Two> find_two(const Asked& asked, const std::vector<std::string>& ids) {
  const auto a = find(asked, ids[0]), b = find(asked, ids[1]);
  if (!a) return a.error();
  if (!b) return b.error();
  if ((*a)->frame_id != (*b)->frame_id) return in_two_frames(**a, **b);
  return Two{*a, *b};
}

std::string in_words(const char* format, double a, double b) {
  char text[80];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}
std::string metres(const Estimate& e) { return in_words("%.2f +- %.2f mm", 1e3 * e.value, 1e3 * e.sigma); }
std::string degrees(const Estimate& e) {
  return in_words("%.3f +- %.3f degrees", e.value / degree, e.sigma / degree);
}
nlohmann::ordered_json to_json(const Estimate& e) { return {{"value", e.value}, {"sigma", e.sigma}}; }

Result<Answer> ask_between(const Asked& asked, const QueryRequest& request) {
  const Result<Two> two = find_two(asked, request.between);
  if (!two) return two.error();
  const Estimate distance = centre_distance(two->a->patch, two->b->patch);
  const Estimate angle = normal_angle(two->a->patch, two->b->patch);
  return Answer{two->a->id + " to " + two->b->id + ": centres " + metres(distance) + " apart, normals " +
                    degrees(angle),
                {{"between", request.between}, {"distance", to_json(distance)}, {"angle", to_json(angle)}}};
}

Result<Answer> ask_tilt(const Asked& asked, const QueryRequest& request) {
  const auto record = find(asked, request.tilt);
  if (!record) return record.error();
  const Vector3d along(request.up[0], request.up[1], request.up[2]);
  if (!(along.norm() > 0.0)) return Error{ErrorCode::usage, "--up is 0,0,0, which is no direction."};
  const Vector3d up = along.normalized();
  const Estimate angle = tilt((*record)->patch, up);
  Answer answer{request.tilt + ": tilt " + degrees(angle),
                {{"patch", request.tilt}, {"tilt", to_json(angle)}}};
  if (request.limit) {
    const double p = tilt_exceeds((*record)->patch, up, *request.limit * degree);
    answer.words += in_words(", over %g degrees with probability %.4g", *request.limit, p);
    answer.json["limit"] = *request.limit * degree;
    answer.json["probability"] = p;
  }
  return answer;
}

Result<Answer> ask_foot(const Asked& asked, const QueryRequest& request) {
  const Result<Two> two = find_two(asked, request.foot);
  if (!two) return two.error();
  const FootFit fit = foot_fit(two->a->patch, two->b->patch);
  return Answer{two->a->id + " over " + two->b->id + ": gap " + metres(fit.gap) + ", rocking " +
                    metres(fit.rocking) +
                    in_words(", %.0f %% of the foot within its bounds", 100.0 * fit.share, 0),
                {{"foot", two->a->id},
                 {"ground", two->b->id},
                 {"gap", to_json(fit.gap)},
                 {"rocking", to_json(fit.rocking)},
                 {"share", fit.share}}};
}

Result<Answer> ask_near(const Asked& asked, const QueryRequest& request) {
  std::vector<Patch> patches;
  for (const PatchRecord& record : asked.records) {
    if (record.frame_id != asked.records.front().frame_id)
      return in_two_frames(asked.records.front(), record);
    patches.push_back(record.patch);
  }
  const Vector3d point(request.near[0], request.near[1], request.near[2]);
  Answer answer{in_words("Within %g m:", request.radius, 0),
                {{"near", request.near}, {"radius", request.radius}}};
  answer.json["patches"] = nlohmann::ordered_json::array();
  for (const NearPatch& found : patches_within(patches, point, request.radius)) {
    const std::string& id = asked.records[found.index].id;
    answer.words += "\n  " + id + in_words("  %.1f mm", 1e3 * found.distance, 0);
    answer.json["patches"].push_back({{"id", id}, {"distance", found.distance}});
  }
  return answer;
}

Result<int> query_map(const QueryRequest& request) {
  const struct {
    bool wanted;
    Result<Answer> (*ask)(const Asked&, const QueryRequest&);
  } questions[] = {{!request.between.empty(), ask_between},
                   {!request.tilt.empty(), ask_tilt},
                   {!request.foot.empty(), ask_foot},
                   {!request.near.empty(), ask_near}};
  const Result<Asked> asked = read_all(request.files);
  if (!asked) return asked.error();
  if (!request.between.empty() || !request.foot.empty()) {
    for (const std::string& file : asked->sharing)
      say(file +
          ": its patches share errors, of joints or a pose; sigmas between two of them count each alone.");
  }
  std::string words;
  nlohmann::ordered_json answers = nlohmann::ordered_json::array();
  for (const auto& question : questions) {
    if (!question.wanted) continue;
    const Result<Answer> answer = question.ask(*asked, request);
    if (!answer) return answer.error();
    words += answer->words + "\n";
    answers.push_back(answer->json);
  }
  if (answers.empty())
    return Error{ErrorCode::usage, "Nothing is asked: give --between, --tilt, --foot or --near."};
  const Result<std::string> text = request.json ? json_text({{"answers", answers}}, "answers") : words;
  if (!text) return text.error();
  Outputs outputs;
  outputs.add("-", *text);
  return outputs.write();
}

}  // namespace

Action set_up_map_query(CLI::App& app) {
  const auto request = std::make_shared<QueryRequest>();
  app.add_option("files", request->files, "patch sets and maps in one frame; - is standard input")
      ->required();
  app.add_option("--between", request->between, "two ids: distance of the centres, angle of the normals")
      ->expected(2);
  app.add_option("--tilt", request->tilt, "an id: the angle between its normal and --up");
  app.add_option("--up", request->up, "against gravity, in the frame of the patches")
      ->delimiter(',')
      ->expected(3)
      ->capture_default_str();
  app.add_option("--limit", request->limit, "degrees: how probable is it that --tilt exceeds this")
      ->check(CLI::Range(1e-6, 180.0 - 1e-6));
  app.add_option("--foot", request->foot, "ids of a foot and of a ground patch: the gap between them")
      ->expected(2);
  app.add_option("--near", request->near, "X,Y,Z in metre: the patches within --radius of it")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--radius", request->radius, "of --near, in metre")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--json", request->json, "print JSON: metre, radian, probability");
  return [request] { return query_map(*request); };
}

}  // namespace patchlab
