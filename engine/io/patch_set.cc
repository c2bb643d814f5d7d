#include "engine/io/patch_set.h"

#include <climits>
#include <set>

#include "engine/io/patch_json.h"
#include "engine/io/pose_covariance.h"

namespace patchlab {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view format_name = "patchlab.patch_set";
// The second: a pose or joints that they share correlate their errors; the file says so, not how. Kept in
// `unknown`.
constexpr const char* correlations = "correlations";
constexpr std::string_view independent = "patches_independent", correlated = "patches_share_errors";
constexpr std::uint64_t version = 1;
constexpr std::uint64_t largest_count = 1ULL << 53;

ordered_json units() { return {{"length", "m"}, {"angle", "rad"}}; }

ordered_json findings_json(const std::vector<Finding>& findings) {
  ordered_json array = ordered_json::array();
  for (const Finding& finding : findings) {
    if (finding.name.empty()) {
      array.push_back(finding.sentence);
    } else {
      array.push_back({{"name", finding.name},
                       {"value", finding.value},
                       {"limit", finding.limit},
                       {"sentence", finding.sentence}});
    }
  }
  return array;
}

ordered_json candidates_json(const std::vector<Candidate>& candidates) {
  ordered_json array = ordered_json::array();
  for (const Candidate& candidate : candidates) {
    array.push_back({{"surface", name(candidate.surface)},
                     {"chi2", candidate.chi2},
                     {"dof", candidate.dof},
                     {"bic", candidate.bic},
                     {"chosen", candidate.chosen},
                     {"reason", candidate.reason}});
  }
  return array;
}

ordered_json fit_json(const FitSummary& fit) {
  ordered_json object = {{"method", name(fit.method)},
                         {"robust", fit.robust},
                         {"containment", fit.containment},
                         {"points", fit.points},
                         {"outliers", fit.outliers},
                         {"chi2", fit.chi2},
                         {"dof", fit.dof},
                         {"p_value", fit.p_value},
                         {"iterations", fit.iterations},
                         {"residual_rms", fit.residual_rms},
                         {"coverage", fit.coverage},
                         {"accepted", fit.accepted},
                         {"reasons", findings_json(fit.reasons)}};
  if (!fit.warnings.empty()) object["warnings"] = findings_json(fit.warnings);
  if (fit.candidates.size() > 1) object["candidates"] = candidates_json(fit.candidates);
  return object;
}

ordered_json source_json(const PatchSource& source) {
  ordered_json object = {
      {"id", source.id}, {"file", source.file}, {"sha256", source.sha256}, {"noise", source.noise}};
  if (source.noise_assumed) object["noise_assumed"] = true;
  object["viewpoint"] = viewpoint_to_json(source.viewpoint);
  return object;
}

ordered_json record_json(const PatchRecord& record) {
  ordered_json object = {{"id", record.id}, {"name", record.name}, {"frame_id", record.frame_id}};
  if (!record.source.empty()) object["source"] = record.source;
  append_patch(object, record.patch);
  if (record.fit) object["fit"] = fit_json(*record.fit);
  if (!record.provenance.is_null()) object["provenance"] = record.provenance;
  return object;
}

// What a record may hold that follows from the rest of it; an export writes more than write_patch_set.
ordered_json known_json(const PatchRecord& record) {
  ordered_json object = record_json(record);
  for (const PoseCovariance& convention : pose_covariances())
    object["pose"]["covariance_" + std::string(convention.name)] = nullptr;
  return object;
}

ordered_json set_json(const PatchSet& set) {
  ordered_json object = {{"format", format_name},
                         {"version", version},
                         {"units", units()},
                         {correlations, set.unknown.value(correlations, std::string(independent))},
                         {"sources", ordered_json::array()},
                         {"patches", ordered_json::array()}};
  for (const PatchSource& source : set.sources) {
    ordered_json& written = object["sources"].emplace_back(source_json(source));
    add_unknown_members(written, source.unknown);
  }
  for (const PatchRecord& record : set.patches) {
    ordered_json& written = object["patches"].emplace_back(record_json(record));
    add_unknown_members(written, record.unknown);
  }
  add_unknown_members(object, set.unknown);
  return object;
}

std::vector<Finding> findings_from_json(const JsonPlace& place) {
  std::vector<Finding> findings;
  for (const JsonPlace& item : place.items()) {
    if (item.value().is_string()) {
      findings.push_back({"", 0.0, 0.0, item.text()});
    } else {
      findings.push_back(
          {item["name"].text(), item["value"].number(), item["limit"].number(), item["sentence"].text()});
    }
  }
  return findings;
}

std::vector<Candidate> candidates_from_json(const JsonPlace& place) {
  std::vector<Candidate> candidates;
  for (const JsonPlace& item : place.items()) {
    const JsonPlace surface = item["surface"];
    const std::optional<SurfaceType> known = surface_from_name(surface.text());
    if (!known) surface.fail("\"" + surface.text() + "\" is not a surface that patchlab knows");
    candidates.push_back({known.value_or(SurfaceType::plane), item["chi2"].number(),
                          static_cast<int>(item["dof"].whole_number(INT_MAX)), item["bic"].number(),
                          item["chosen"].boolean(), item["reason"].text()});
  }
  return candidates;
}

FitSummary fit_from_json(const JsonPlace& place) {
  FitSummary fit;
  const JsonPlace method = place["method"];
  const std::optional<FitMethod> known = fit_method_from_name(method.text());
  if (!known) method.fail("\"" + method.text() + "\" is not a fit method that patchlab knows");
  fit.method = known.value_or(FitMethod::calibrated);
  fit.robust = place["robust"].boolean();
  fit.containment = place["containment"].number();
  fit.points = place["points"].whole_number(largest_count);
  fit.outliers = place["outliers"].whole_number(largest_count);
  fit.chi2 = place["chi2"].number();
  fit.dof = static_cast<int>(place["dof"].whole_number(INT_MAX));
  fit.p_value = place["p_value"].number();
  fit.iterations = static_cast<int>(place["iterations"].whole_number(INT_MAX));
  fit.residual_rms = place["residual_rms"].number();
  fit.coverage = place["coverage"].number();
  fit.accepted = place["accepted"].boolean();
  fit.reasons = findings_from_json(place["reasons"]);
  if (const auto warnings = place.find("warnings")) fit.warnings = findings_from_json(*warnings);
  if (const auto candidates = place.find("candidates")) fit.candidates = candidates_from_json(*candidates);
  return fit;
}

PatchSource source_from_json(const JsonPlace& place) {
  PatchSource source;
  source.id = place["id"].text();
  source.file = place["file"].text();
  source.sha256 = place["sha256"].text();
  source.noise = place["noise"].text();
  const auto assumed = place.find("noise_assumed");
  source.noise_assumed = assumed && assumed->boolean();
  source.viewpoint = viewpoint_from_json(place["viewpoint"]);
  if (place.ok()) source.unknown = unknown_members(place.value(), source_json(source));
  return source;
}

std::string optional_text(const JsonPlace& place, const std::string& key) {
  const auto text = place.find(key);
  return text ? text->text() : std::string();
}

PatchRecord record_from_json(const JsonPlace& unnamed) {
  PatchRecord record;
  record.id = unnamed["id"].text();
  if (record.id.empty()) unnamed["id"].fail("is empty");
  const JsonPlace place = unnamed.called("patch \"" + record.id + "\"");
  record.name = optional_text(place, "name");
  record.frame_id = place["frame_id"].text();
  record.source = optional_text(place, "source");
  record.patch = patch_from_json(place);
  if (const auto fit = place.find("fit")) record.fit = fit_from_json(*fit);
  if (const auto provenance = place.find("provenance")) record.provenance = provenance->value();
  if (place.ok()) record.unknown = unknown_members(place.value(), known_json(record));
  return record;
}

// What must stand as this version writes it, so that the numbers mean what they say.
void check_heading(const JsonPlace& root) {
  const JsonPlace format = root["format"], stated_version = root["version"];
  if (format.text() != format_name) format.fail("is not \"" + std::string(format_name) + "\"");
  if (stated_version.number() >= static_cast<double>(version + 1)) {
    stated_version.fail(stated_version.value().dump() + " of " + std::string(format_name) +
                        " is newer than this program, which reads version 1; use a newer patchlab");
  }
  if (root.ok() && stated_version.number() < static_cast<double>(version)) stated_version.fail("is below 1");
  if (const auto stated = root.find("units"); stated && stated->value() != json(units())) {
    stated->fail("are " + stated->value().dump() + ", but patch sets are in metre (m) and radian (rad)");
  }
  if (const auto stated = root.find(correlations);
      stated && stated->text() != independent && stated->text() != correlated) {
    stated->fail("are \"" + stated->text() + "\", which this program does not know");
  }
}

}  // namespace

FitSummary::FitSummary(const FitReport& report)
    : method(report.method),
      robust(report.robust),
      containment(report.containment),
      points(report.points),
      outliers(report.outliers.size()),
      chi2(report.chi2),
      dof(report.dof),
      p_value(report.p_value),
      iterations(report.iterations),
      residual_rms(report.residual_rms),
      coverage(report.coverage),
      accepted(report.accepted),
      reasons(report.reasons),
      warnings(report.warnings),
      candidates(report.candidates) {}

Result<std::string> write_patch_set(const PatchSet& set) {
  for (const PatchRecord& record : set.patches) {
    if (const std::string problem = not_finite(record_json(record)); !problem.empty()) {
      return Error{ErrorCode::refused, "patch \"" + record.id + "\": " + problem + "; nothing was written."};
    }
  }
  return json_text(set_json(set), "patch set");
}

Result<PatchSet> read_patch_set(std::string_view text, const std::string& name) {
  const Result<json> parsed = parse_json(text, name);
  if (!parsed) return parsed.error();
  std::optional<Error> error;
  const JsonPlace root(*parsed, name, error);
  check_heading(root);
  PatchSet set;
  if (const auto sources = root.find("sources")) {
    for (const JsonPlace& place : sources->items()) set.sources.push_back(source_from_json(place));
  }
  std::set<std::string> ids;
  for (const JsonPlace& place : root["patches"].items()) {
    set.patches.push_back(record_from_json(place));
    if (!ids.insert(set.patches.back().id).second) place["id"].fail("is taken by an earlier patch");
  }
  if (error) return *error;
  set.unknown = unknown_members(*parsed, set_json({}));
  if (parsed->value(correlations, "") == correlated) set.unknown[correlations] = correlated;
  return set;
}

}  // namespace patchlab
