// patchlab: the command line.
#include <CLI/CLI.hpp>
#include <new>
#include <vector>

#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/project/journal.h"

namespace patchlab {
namespace {

constexpr Verb verbs[] = {
    {"info", "Say what a scan holds", set_up_info},
    {"fit", "Fit a patch to points of a scan", set_up_fit},
    {"simulate", "Scan a scene with a simulated range camera", set_up_simulate},
    {"export", "Write a patch set in another format", set_up_export},
    {"replay", "Do again what a journal says", set_up_replay},
    {"help", "Explain a verb or a topic: noise, formats", set_up_help},
};
constexpr Verb map_verbs[] = {
    {"chain", "Compose a chain of uncertain poses", set_up_map_chain},
    {"robot", "Put the patches of a robot where its joints put them", set_up_map_robot},
    {"merge", "Find what two patch sets both see, and fuse it", set_up_map_merge},
    {"query", "Ask how far, how tilted, how well a foot fits, with sigmas", set_up_map_query},
    {"touch", "Measure a patch anew by a foot or a point in contact", set_up_map_touch},
};

struct Choice {
  CLI::App* app;
  Action action;
};

template <std::size_t n>
void add_verbs(CLI::App& app, const Verb (&rows)[n], std::vector<Choice>& choices) {
  for (const Verb& verb : rows) {
    CLI::App* const sub = app.add_subcommand(verb.name, verb.summary);
    choices.push_back({sub, verb.set_up(*sub)});
  }
  app.require_subcommand(1);
}

int run(const std::vector<Choice>& choices) {
  for (const auto& [app, action] : choices) {
    if (!app->parsed()) continue;
    const Result<int> status = action();
    if (status) return *status;
    say(status.error().message);
    return exit_status(status.error().code);
  }
  return exit_status(ErrorCode::usage);
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Range scans to bounded curved patches with honest uncertainty.", "patchlab");
  app.set_version_flag("--version", program());
  std::vector<Choice> choices;
  add_verbs(app, verbs, choices);
  CLI::App* const map =
      app.add_subcommand("map", "Work with patch maps: poses, robots, several sights of one surface");
  add_verbs(*map, map_verbs, choices);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_status(ErrorCode::usage);
  }
  return run(choices);
}

}  // namespace
}  // namespace patchlab

int main(int argc, char** argv) try {
  return patchlab::run_command_line(argc, argv);
} catch (const std::bad_alloc&) {
  patchlab::say("There is not enough memory for this; work on a smaller scan or region.");
  return patchlab::exit_status(patchlab::ErrorCode::unreadable);
}
