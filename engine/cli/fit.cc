#include <map>
#include <memory>
#include <numeric>

#include "engine/base/file.h"
#include "engine/cli/fit_table.h"
#include "engine/cli/options.h"
#include "engine/cli/output.h"
#include "engine/cli/region_file.h"
#include "engine/cli/verb.h"
#include "engine/project/session.h"

namespace patchlab {
namespace {

struct FitRequest {
  OpenScan open{.id = "scan-1", .file = {}};
  ScanFlags flags;
  std::string region_file;
  std::optional<std::uint32_t> label;
  FitOptions options;
  std::vector<double> viewpoint;
  std::string id = "patch-1", output;
  bool json = false, require_accepted = false, explain = false;
};

std::optional<bool> on_off(std::string_view name) {
  return name == "on" ? std::optional(true) : name == "off" ? std::optional(false) : std::nullopt;
}

// The points asked for, as the command that selects them.
Result<Select> selection(const FitRequest& request, const Scan& scan) {
  Select select{.region = "all", .scan = request.open.id};
  if (request.label) {
    select.region = "label-" + std::to_string(*request.label);
    select.label = request.label;
  } else if (!request.region_file.empty()) {
    const Result<Bytes> bytes = read_file(request.region_file);
    if (!bytes) return bytes.error();
    Result<std::vector<std::uint32_t>> ids = parse_region(as_text(*bytes), request.region_file);
    if (!ids) return ids.error();
    select.region = std::filesystem::path(request.region_file).filename().string();
    select.indices = std::move(*ids);
  } else {
    std::vector<std::uint32_t>& all = select.indices.emplace(scan.size());
    std::iota(all.begin(), all.end(), 0u);
  }
  return select;
}

void say_assumptions(const ScanEntry& entry) {
  for (const std::string& notice : entry.scan->notices) say(entry.name + ": " + notice);
  if (!entry.noise.assumed) return;
  say(entry.name + ": nobody stated a noise model, so " + entry.noise.specification +
      " is assumed; name one with --noise.");
}

Result<Document> run(const FitRequest& request) {
  ProgressLine line("fitting");
  const ApplyOptions options{.folder = {}, .on = {}, .progress = line.progress()};
  Session session;
  const Result<void> opened = session.run(request.open, options);
  if (!opened) return opened.error();
  Result<Select> select = selection(request, *session.document().scans.front().scan);
  if (!select) return select.error();
  Fit fit{.patch = request.id, .region = select->region, .options = request.options};
  for (const Command& command : {Command{std::move(*select)}, Command{std::move(fit)}}) {
    const Result<void> done = session.run(command, options);
    if (!done) return done.error();
  }
  return session.document();
}

Result<int> fit(const FitRequest& request) {
  if (request.open.file == "-" && request.region_file == "-") {
    return Error{ErrorCode::usage, "Scan and region cannot both come from standard input."};
  }
  const Result<Document> document = run(request);
  if (!document) return document.error();
  const PatchEntry& patch = document->patches.front();
  say_assumptions(document->scans.front());
  if (request.explain) {
    for (const std::string& step : steps_in_words(patch.fit->report)) say(step);
  }
  Outputs outputs;
  Result<std::string> set = write_patch_set(patch_set(*document));
  if (!set) return set.error();
  if (!request.output.empty()) outputs.add(request.output, *set);
  if (request.json && request.output != "-") outputs.add("-", *set);
  if (!request.json && request.output != "-") outputs.add("-", fit_table(*document, patch));
  const Result<int> written = outputs.write();
  if (!written) return written;
  return request.require_accepted && !patch.fit->report.accepted ? exit_status(ErrorCode::refused) : 0;
}

// p_value=1e-6, residual_rms=0.02 ...: the limits of the validation, named as in the journal.
void add_limits(CLI::App& app, ValidationLimits& limits) {
  const std::map<std::string, double ValidationLimits::*> names = {
      {"p_value", &ValidationLimits::p_value},
      {"residual_rms", &ValidationLimits::residual_rms},
      {"coverage", &ValidationLimits::coverage},
      {"curvature_extent", &ValidationLimits::curvature_extent}};
  app.add_option_function<std::vector<std::string>>(
         "--limit",
         [names, &limits](const std::vector<std::string>& settings) {
           for (const std::string& setting : settings) {
             const std::size_t equals = setting.find('=');
             const auto known = names.find(setting.substr(0, equals));
             double value = 0.0;
             if (equals == std::string::npos || known == names.end() ||
                 !CLI::detail::lexical_cast(setting.substr(equals + 1), value)) {
               throw CLI::ValidationError("--limit", setting +
                                                         " is not one of p_value=, residual_rms= (m), "
                                                         "coverage=, curvature_extent= and a number");
             }
             limits.*known->second = value;
           }
         },
         "a limit of the validation: NAME=VALUE, NAME of p_value, residual_rms (m), coverage, curvature_extent")
      ->allow_extra_args(false)
      ->take_all();
}

void add_fit_options(CLI::App& app, FitOptions& options) {
  add_named(app, "--surface", options.surface, surface_request_from_name,
            "auto|paraboloid|plane|sphere|circular_cylinder|elliptic_paraboloid|hyperbolic_paraboloid|"
            "cylindric_paraboloid|circular_paraboloid",
            "what to fit; paraboloid chooses among the five paraboloids, plane included");
  add_named(app, "--boundary", options.boundary, boundary_request_from_name,
            "auto|ellipse|circle|rectangle|convex_quad", "the boundary of a plane");
  app.add_option("--containment", options.containment, "share of the patch inside the boundary, in (0, 1]");
  add_named(app, "--method", options.method, fit_method_from_name, "calibrated|paper", "how to fit");
  add_named(app, "--bounds", options.bounds, bounds_method_from_name, "extent|paper",
            "how to bound; follows the method where it is not given");
  add_limits(app, options.limits);
  add_named(app, "--robust", options.robust, on_off, "on|off", "set outliers aside")
      ->expected(0, 1)
      ->default_str("on");
}

}  // namespace

Action set_up_fit(CLI::App& app) {
  const auto request = std::make_shared<FitRequest>();
  app.add_option("scan", request->open.file, "a scan; - is standard input")->required();
  CLI::Option* const region =
      app.add_option("--region", request->region_file, "point indices, one a line or JSON");
  app.add_option("--label", request->label, "the points with this label")->excludes(region);
  add_fit_options(app, request->options);
  app.add_option("--noise", request->open.noise, "noise model, see patchlab help noise");
  app.add_option("--viewpoint", request->viewpoint, "where the sensor stood: X,Y,Z in metre")
      ->delimiter(',')
      ->expected(3);
  add_scan_flags(app, request->flags);
  app.add_option("-o,--output", request->output, "write a patch set; - is standard output");
  app.add_flag("--json", request->json, "print the patch set instead of a table");
  app.add_option("--id", request->id, "the patch's id in the set; two sets that are merged name theirs apart")
      ->capture_default_str();
  app.add_flag("--require-accepted", request->require_accepted,
               "exit 1 where validation does not accept the fit");
  app.add_flag("--explain", request->explain, "tell the steps of the fit on standard error");
  return [request] {
    const std::vector<double>& v = request->viewpoint;
    if (!v.empty()) request->open.viewpoint = Eigen::Vector3d(v[0], v[1], v[2]);
    if (const Result<void> told = tell(request->flags, request->open); !told)
      return Result<int>(told.error());
    return fit(*request);
  };
}

}  // namespace patchlab
