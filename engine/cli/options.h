// Options that several verbs share, and options whose values are names.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/io/scan_options.h"

namespace patchlab {

// `names` are what the option takes, for the help and for the message: "extent|paper". `from_name` gives a
// std::optional.
template <class T, class FromName>
CLI::Option* add_named(CLI::App& app, const std::string& option, T& value, FromName from_name,
                       const std::string& names, const std::string& summary) {
  const auto parse = [&value, from_name, option, names](const std::string& text) {
    const auto named = from_name(text);
    if (!named) throw CLI::ValidationError(option, "'" + text + "' is none of " + names);
    value = *named;
  };
  return app.add_option_function<std::string>(option, parse, summary)->type_name(names);
}

// What the user says of a scan file: of every verb that takes one.
struct ScanFlags {
  bool points_in_sensor_frame = false;
  LengthUnit unit = LengthUnit::m;
  std::string intrinsics;  // four numbers, or a file
  double depth_scale = 0.0;
};
void add_scan_flags(CLI::App& app, ScanFlags& flags);

// usage or unreadable error where the text of --intrinsics is neither numbers nor a file that holds them.
Result<std::optional<Intrinsics>> intrinsics_of(const ScanFlags& flags);

// The same, said to a ReadOptions or an OpenScan.
template <class Reading>
Result<void> tell(const ScanFlags& flags, Reading& reading) {
  Result<std::optional<Intrinsics>> intrinsics = intrinsics_of(flags);
  if (!intrinsics) return intrinsics.error();
  reading.points_in_sensor_frame = flags.points_in_sensor_frame;
  reading.unit = flags.unit;
  reading.intrinsics = *intrinsics;
  reading.depth_scale = flags.depth_scale;
  return {};
}

}  // namespace patchlab
