#include <memory>
#include <optional>

#include "engine/cli/fit_table.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/export/export.h"
#include "engine/project/measured_points.h"
#include "engine/project/session.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

struct ReplayRequest {
  std::string journal;
  std::string output, map;
  std::vector<std::string> exports;  // FORMAT=FILE
  std::string on;
  bool json = false;
};

struct Export {
  const ExportFormat* format;
  fs::path file;
};

Result<std::vector<Export>> parse_exports(const std::vector<std::string>& texts) {
  std::vector<Export> exports;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) {
      return Error{ErrorCode::usage,
                   "--export takes FORMAT=FILE, as in ply=patches.ply, not '" + text + "'."};
    }
    const Result<const ExportFormat*> format = export_format(text.substr(0, equals));
    if (!format) return format.error();
    exports.push_back({*format, text.substr(equals + 1)});
  }
  return exports;
}

Result<void> check_outputs(const ReplayRequest& request, const std::vector<Export>& exports) {
  std::vector<fs::path> files = {request.output, request.map, request.json ? "-" : ""};
  for (const Export& one : exports) files.push_back(one.file);
  return Outputs::check(files);
}

// The one map of a document as text; usage error where it has none, or several.
Result<std::string> text_of_map(const Document& document) {
  if (document.maps.size() == 1) return write_patch_set(*document.maps.front().set);
  return Error{ErrorCode::usage, "--map takes the one map of a document, and this journal leaves " +
                                     std::to_string(document.maps.size()) + "."};
}

Result<int> replay_journal(const ReplayRequest& request) {
  const Result<std::vector<Export>> exports = parse_exports(request.exports);
  if (!exports) return exports.error();
  const Result<void> checked = check_outputs(request, *exports);
  if (!checked) return checked.error();
  ProgressLine line("replaying");
  ApplyOptions options{.folder = {}, .on = {}, .progress = line.progress()};
  if (!request.on.empty()) options.on = request.on;
  const Result<Document> document = replay(request.journal, options);
  if (!document) return document.error();
  const std::optional<std::string> other_results = notice_of_other_results(*document);
  if (other_results) say(*other_results);

  const PatchSet set = patch_set(*document, fs::path(request.journal).filename().string());
  const Result<std::string> text = write_patch_set(set);
  if (!text) return text.error();
  Outputs outputs;
  if (!request.output.empty()) outputs.add(request.output, *text);
  if (!request.map.empty()) {
    const Result<std::string> map = text_of_map(*document);
    if (!map) return map.error();
    outputs.add(request.map, *map);
  }
  std::vector<std::string> notices;
  const ExportOptions with_points{.measured = measured_points(*document)};
  for (const auto& [format, file] : *exports) {
    Result<Exported> exported = export_patches(*format, set, with_points);
    if (!exported) return exported.error();
    notices.insert(notices.end(), exported->notices.begin(), exported->notices.end());
    outputs.add(file, std::move(*exported));
  }
  if (request.json) outputs.add("-", *text);
  const bool writes = !request.output.empty() || !request.map.empty() || !exports->empty();
  if (!request.json && !writes) {
    std::string tables;
    for (const PatchEntry& patch : document->patches) tables += fit_table(*document, patch);
    outputs.add("-", std::move(tables));
  }
  const Result<int> written = outputs.write();
  for (const std::string& notice : notices) say(notice);
  return written && (other_results || !notices.empty()) ? Result<int>(exit_status(ErrorCode::refused))
                                                        : written;
}

}  // namespace

Action set_up_replay(CLI::App& app) {
  const auto request = std::make_shared<ReplayRequest>();
  app.add_option("journal", request->journal, "a journal; - is standard input")->required();
  app.add_option("-o,--output", request->output, "write the patch set; - is standard output");
  app.add_option("--map", request->map, "write the map that its merges made, as map merge does");
  app.add_option("--export", request->exports, "FORMAT=FILE, once for each; see patchlab help formats")
      ->allow_extra_args(false)
      ->expected(1)
      ->take_all();
  app.add_option("--on", request->on, "run it on this scan instead of the recorded one");
  app.add_flag("--json", request->json, "print the patch set instead of tables");
  return [request] { return replay_journal(*request); };
}

}  // namespace patchlab
