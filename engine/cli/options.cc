#include "engine/cli/options.h"

#include <cmath>
#include <optional>
#include <string_view>

#include "engine/base/file.h"
#include "engine/io/text_numbers.h"

namespace patchlab {

void add_scan_flags(CLI::App& app, ScanFlags& flags) {
  const auto sensor_from_name = [](std::string_view name) {
    return name == "sensor" ? std::optional(true) : name == "file" ? std::optional(false) : std::nullopt;
  };
  add_named(app, "--points-in", flags.points_in_sensor_frame, sensor_from_name, "file|sensor",
            "the frame of a PCD file's points: as they stand, or the sensor's");
  add_named(app, "--unit", flags.unit, length_unit_from_name, "m|mm|cm|in",
            "the unit of the lengths in the file, metre where it is not given");
  app.add_option(
      "--intrinsics", flags.intrinsics,
      "of a depth image: fx,fy,cx,cy in pixels, or a file (ROS camera_info, Open3D JSON, 3x3 matrix)");
  app.add_option("--depth-scale", flags.depth_scale,
                 "of a depth image: raw units a metre, 1000 for millimetres")
      ->check([](const std::string& text) {
        const auto scale = parse_number<double>(text);
        return scale && *scale > 0.0 && std::isfinite(*scale) ? "" : "takes a positive number, not " + text;
      });
}

Result<std::optional<Intrinsics>> intrinsics_of(const ScanFlags& flags) {
  if (flags.intrinsics.empty()) return std::optional<Intrinsics>{};
  if (const Result<Intrinsics> numbers = parse_intrinsics(flags.intrinsics, "--intrinsics"))
    return std::optional(*numbers);
  const Result<Bytes> bytes = read_file(flags.intrinsics);
  if (!bytes) {
    return Error{
        ErrorCode::usage,
        "--intrinsics takes fx,fy,cx,cy in pixels or a file that holds them, but " + bytes.error().message};
  }
  const Result<Intrinsics> read = parse_intrinsics(as_text(*bytes), flags.intrinsics);
  if (!read) return read.error();
  return std::optional(*read);
}

}  // namespace patchlab
