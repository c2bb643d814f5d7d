// A verb of the command line: its options, and what it does with them.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "engine/base/result.h"

namespace patchlab {

// Exit status of a verb that worked: 0, or 1 where some items were refused.
using Action = std::function<Result<int>()>;

struct Verb {
  const char* name;
  const char* summary;
  Action (*set_up)(CLI::App& app);  // adds the options; the action reads them once they are parsed
};

Action set_up_info(CLI::App& app);
Action set_up_fit(CLI::App& app);
Action set_up_simulate(CLI::App& app);
Action set_up_map_chain(CLI::App& app);
Action set_up_map_robot(CLI::App& app);
Action set_up_map_merge(CLI::App& app);
Action set_up_map_query(CLI::App& app);
Action set_up_map_touch(CLI::App& app);
Action set_up_export(CLI::App& app);
Action set_up_replay(CLI::App& app);
Action set_up_help(CLI::App& app);

}  // namespace patchlab
