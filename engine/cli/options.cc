#include "engine/cli/options.h"

#include <optional>
#include <string_view>

namespace patchlab {

void add_points_in(CLI::App& app, bool& in_sensor_frame) {
  const auto from_name = [](std::string_view name) {
    return name == "sensor" ? std::optional(true) : name == "file" ? std::optional(false) : std::nullopt;
  };
  add_named(app, "--points-in", in_sensor_frame, from_name, "file|sensor",
            "the frame of a PCD file's points: as they stand, or the sensor's");
}

}  // namespace patchlab
