// What a scan file leaves open and the user says: the unit of its lengths, the camera behind a depth image.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace patchlab {

enum class LengthUnit { m, mm, cm, in };

std::string_view name(LengthUnit unit);  // "m" ...
std::optional<LengthUnit> length_unit_from_name(std::string_view name);
double metres(LengthUnit unit);  // in one of it

// A pinhole camera: a point (x, y, z) of its frame, z forward, is seen at pixel (fx x/z + cx, fy y/z + cy).
struct Intrinsics {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  // px
  std::uint32_t width = 0, height = 0;            // of the pictures they were found for; 0: not said
  bool distorted = false;                         // a distortion is stated too, which nothing here corrects
};

// Intrinsics as four numbers fx fy cx cy, as a 3x3 (or 4x4) matrix row by row, as ROS camera_info in YAML
// (camera_calibration's camera_matrix, or K of ROS 1, k of ROS 2) or as Open3D's JSON, whichever the text is.
// unreadable error: `name` and what is wrong.
Result<Intrinsics> parse_intrinsics(std::string_view text, const std::string& name);

}  // namespace patchlab
