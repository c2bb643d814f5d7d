#include "engine/export/export.h"

#include <memory>
#include <numbers>

#include "engine/base/file.h"
#include "engine/cli/options.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"

namespace patchlab {
namespace {

struct ExportRequest {
  std::string set;
  std::string format;
  std::string output = "-";
  std::vector<double> up = {0.0, 0.0, 1.0};
  double tilt_limit = 30.0;  // degrees
  bool dry_run = false;
  ExportOptions options;
};

int print_preview(const ExportPreview& preview) {
  std::string text = "patches:";
  for (const std::string& id : preview.patches) text += " " + id;
  for (const std::string& line : preview.lines) text += "\n" + line;
  return write_file("-", text + "\n") ? 0 : exit_status(ErrorCode::unwritable);
}

Result<int> export_set(const ExportRequest& request) {
  const Result<const ExportFormat*> format = export_format(request.format);
  if (!format) return format.error();
  const Result<Bytes> bytes = read_file(request.set);
  if (!bytes) return bytes.error();
  const Result<PatchSet> set =
      read_patch_set(as_text(*bytes), request.set == "-" ? "standard input" : request.set);
  if (!set) return set.error();
  ExportOptions options = request.options;
  options.up = Vector3d::Map(request.up.data());
  options.tilt_limit = request.tilt_limit * std::numbers::pi / 180.0;
  const Result<Exported> exported = export_patches(**format, *set, options);
  if (!exported) return exported.error();
  if (request.dry_run) return print_preview(preview_export(**format, *set, options));
  const Result<void> written = write_exported(*exported, request.output);
  if (!written) return written.error();
  if ((*format)->covariance == "none")
    say("The format " + request.format + " holds no covariance; the patch set does.");
  for (const std::string& notice : exported->notices) say(notice);
  return exported->notices.empty() ? 0 : exit_status(ErrorCode::refused);
}

}  // namespace

Action set_up_export(CLI::App& app) {
  const auto request = std::make_shared<ExportRequest>();
  ExportOptions& options = request->options;
  app.add_option("patches", request->set, "a patch set; - is standard input")->required();
  app.add_option("--format", request->format, "see patchlab help formats")->required();
  app.add_option("--patch", options.patches, "only the patch of this id; may be repeated")
      ->allow_extra_args(false);
  app.add_option("-o,--output", request->output, "where to write; standard output without it");
  app.add_option("--thickness", options.thickness,
                 "meshes as closed solids this thick, m; worlds are 0.005 without it");
  app.add_option("--covariance", options.covariances,
                 "patch_set: a further covariance of each pose: right_rot_trans, left_rot_trans or "
                 "ros_fixed_axes; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--inset-sigmas", options.inset_sigmas,
                 "footholds: standard deviations of the outline to keep away from")
      ->capture_default_str();
  app.add_option("--foot-radius", options.foot_radius, "footholds: m to keep away from the outline besides")
      ->capture_default_str();
  app.add_option("--up", request->up, "footholds: against gravity, X,Y,Z; 0,0,1 without it")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--tilt-limit", request->tilt_limit,
                 "footholds: degrees, whose probability to be exceeded is written")
      ->capture_default_str();
  app.add_flag("--dry-run", request->dry_run, "say what would be written, and write nothing");
  return [request] { return export_set(*request); };
}

}  // namespace patchlab
