#include <memory>

#include "engine/base/file.h"
#include "engine/cli/chain_file.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/io/json.h"

namespace patchlab {
namespace {

struct MapRequest {
  std::string file;
  std::string output = "-";
  bool json = false;
};

Result<int> compose_chain(const MapRequest& request) {
  const Result<Bytes> bytes = read_file(request.file);
  if (!bytes) return bytes.error();
  const Result<Chain> chain =
      parse_chain(as_text(*bytes), request.file == "-" ? "standard input" : request.file);
  if (!chain) return chain.error();
  const Result<std::string> text = json_text(to_json(compose(*chain)), request.file);
  if (!text) return text.error();
  Outputs outputs;
  outputs.add(request.output, *text);
  return outputs.write();
}

}  // namespace

Action set_up_map_chain(CLI::App& app) {
  const auto request = std::make_shared<MapRequest>();
  app.add_option("file", request->file, "JSON: elements from the base to the end; - is standard input")
      ->required();
  app.add_option("-o,--output", request->output,
                 "where to write the composed pose; standard output without it");
  app.add_flag("--json", request->json, "print JSON, which it does anyway");
  return [request] { return compose_chain(*request); };
}

}  // namespace patchlab
