#include <memory>

#include "engine/base/file.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/io/read_scan.h"
#include "engine/io/scene.h"

namespace patchlab {
namespace {

struct SimulateRequest {
  std::string scene;
  std::uint64_t seed = 1;
  std::string noise;
  std::string output;
  std::string truth;
};

Result<int> simulate_scene(const SimulateRequest& request) {
  const Result<void> checked = Outputs::check({request.output, request.truth});
  if (!checked) return checked.error();
  const Result<Bytes> bytes = read_file(request.scene);
  if (!bytes) return bytes.error();
  const bool is_input = request.scene == "-";
  const Result<SceneDescription> scene =
      read_scene(as_text(*bytes), is_input ? "standard input" : request.scene,
                 is_input ? std::filesystem::path() : std::filesystem::path(request.scene).parent_path());
  if (!scene) return scene.error();
  const Result<SimulatedScene> simulated = simulate(*scene, request.noise, request.seed);
  if (!simulated) return simulated.error();
  Outputs outputs;
  outputs.add(request.output, write_pcd(simulated->scan));
  if (!request.truth.empty()) {
    Result<std::string> truth = write_patch_set(simulated->truth);
    if (!truth) return truth.error();
    outputs.add(request.truth, std::move(*truth));
  }
  return outputs.write();
}

}  // namespace

Action set_up_simulate(CLI::App& app) {
  const auto request = std::make_shared<SimulateRequest>();
  app.add_option("scene", request->scene, "a scene in JSON; - is standard input")->required();
  app.add_option("--seed", request->seed, "of the noise: the same seed gives the same bytes");
  app.add_option("--noise", request->noise, "a noise model instead of the scene's, see patchlab help noise");
  app.add_option("-o,--output", request->output, "the scan, as PCD; - is standard output")->required();
  app.add_option("--truth", request->truth, "the scene's patches, as a patch set");
  return [request] { return simulate_scene(*request); };
}

}  // namespace patchlab
