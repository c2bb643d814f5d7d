#include <memory>

#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/export/export.h"
#include "engine/sensor/noise_model.h"

namespace patchlab {
namespace {

std::string formats_help() {
  std::string text = "Formats of patchlab export and replay --export:\n";
  for (const ExportFormat& format : export_formats()) {
    text += "  " + std::string(format.name) + " (" +
            (format.is_folder() ? "a folder" : std::string(format.extension)) + ")  " +
            std::string(format.description) + "\n      covariance: " + std::string(format.covariance) + "\n";
  }
  return text;
}

struct Topic {
  std::string_view name;
  std::string (*text)();
};
constexpr Topic topics[] = {{"noise", noise_help}, {"formats", formats_help}};

Result<std::string> help_on(const std::string& name, const CLI::App& program) {
  if (name.empty()) return program.help();
  for (const Topic& topic : topics) {
    if (topic.name == name) return topic.text();
  }
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_name() == name) return verb->help();
  }
  return Error{ErrorCode::usage,
               "There is no help on '" + name + "'; ask for a verb, for noise or for formats."};
}

}  // namespace

Action set_up_help(CLI::App& app) {
  const auto name = std::make_shared<std::string>();
  app.add_option("topic", *name, "a verb, noise or formats");
  return [name, &app]() -> Result<int> {
    const Result<std::string> text = help_on(*name, *app.get_parent());
    if (!text) return text.error();
    Outputs outputs;
    outputs.add("-", *text);
    return outputs.write();
  };
}

}  // namespace patchlab
