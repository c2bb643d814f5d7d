// calibration: runs the Monte Carlo battery for both methods and writes its tables and plots into a folder.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/file.h"
#include "tests/bench/calibration/plots.h"
#include "tests/bench/calibration/report.h"
#include "tests/bench/calibration/study.h"

namespace patchlab::calibration {
namespace {

Result<void> write_all(const Study& study, const std::filesystem::path& folder) {
  const std::vector<std::pair<std::string_view, std::string>> files = {
      {"calibration.md", report(study)},
      {surface_probability_file, surface_probability_plot(study)},
      {full_probability_file, full_probability_plot(study)},
      {coverage_file, coverage_plot(study)},
      {bounds_file, bounds_plot(study)},
      {starts_file, starts_plot(study)},
  };
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);  // write_file names what is wrong with the folder
  for (const auto& [file, text] : files) {
    const Result<void> written = write_file(folder / file, text);
    if (!written) return written;
  }
  return {};
}

int run(const Settings& settings, const std::filesystem::path& folder) {
  const Study study =
      run_study(settings, [](const std::string& stage) { std::fprintf(stderr, "%s\n", stage.c_str()); });
  const Result<void> written = write_all(study, folder);
  if (written) return 0;
  std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return exit_status(written.error().code);
}

}  // namespace
}  // namespace patchlab::calibration

int main(int argc, char** argv) {
  using namespace patchlab;
  calibration::Settings settings;
  settings.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::filesystem::path folder;
  const std::map<std::string, test::NoiseMode> noises = {{"linear", test::NoiseMode::linear},
                                                         {"sensor", test::NoiseMode::sensor}};
  CLI::App app("Is the covariance true? Fits of simulated scans against their truth, as tables and plots.",
               "calibration");
  app.add_option("--trials", settings.trials, "fits of a type and a table's cell")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  app.add_option("--seed", settings.seed, "of every random number")->capture_default_str();
  app.add_option("--points", settings.points, "of a scan")
      ->check(CLI::Range(30, 100000))
      ->capture_default_str();
  app.add_option("--noise", settings.noise,
                 "linear: Gaussian in x, y, z with a known covariance; sensor: in pixel and disparity")
      ->transform(CLI::CheckedTransformer(noises));
  app.add_option("--threads", settings.threads, "changes no number")->check(CLI::Range(1, 1024));
  app.add_option("-o", folder, "the folder to write into")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_status(ErrorCode::usage);
  }
  return calibration::run(settings, folder);
}
