#include "engine/io/export.h"

#include <memory>

#include "engine/base/file.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"

namespace patchlab {
namespace {

struct ExportRequest {
  std::string set;
  std::string format;
  std::string output = "-";
};

Result<int> export_set(const ExportRequest& request) {
  const Result<const ExportFormat*> format = export_format(request.format);
  if (!format) return format.error();
  const Result<Bytes> bytes = read_file(request.set);
  if (!bytes) return bytes.error();
  const Result<PatchSet> set =
      read_patch_set(as_text(*bytes), request.set == "-" ? "standard input" : request.set);
  if (!set) return set.error();
  const Result<std::string> text = (*format)->write(*set);
  if (!text) return text.error();
  Outputs outputs;
  outputs.add(request.output, *text);
  return outputs.write();
}

}  // namespace

Action set_up_export(CLI::App& app) {
  const auto request = std::make_shared<ExportRequest>();
  app.add_option("patches", request->set, "a patch set; - is standard input")->required();
  app.add_option("--format", request->format, "see patchlab help formats")->required();
  app.add_option("-o,--output", request->output, "where to write; standard output without it");
  return [request] { return export_set(*request); };
}

}  // namespace patchlab
