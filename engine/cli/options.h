// Options that several verbs share, and options whose values are names.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace patchlab {

// `names` are what the option takes, for the help and for the message: "extent|paper". `from_name` gives a
// std::optional.
template <class T, class FromName>
void add_named(CLI::App& app, const std::string& option, T& value, FromName from_name,
               const std::string& names, const std::string& summary) {
  const auto parse = [&value, from_name, option, names](const std::string& text) {
    const auto named = from_name(text);
    if (!named) throw CLI::ValidationError(option, "'" + text + "' is none of " + names);
    value = *named;
  };
  app.add_option_function<std::string>(option, parse, summary)->type_name(names);
}

void add_points_in(CLI::App& app, bool& in_sensor_frame);

}  // namespace patchlab
