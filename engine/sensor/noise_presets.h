// Depth cameras by name: what is known of their noise, as data.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "engine/sensor/noise_model.h"

namespace patchlab {

struct NoisePreset {
  std::string_view name;
  std::variant<StereoNoise, DepthNoise> noise;
  std::string_view camera;   // which it is
  std::string_view formula;  // with its numbers, z in metres
  std::string_view source;   // of the numbers, and what is not known
};

std::span<const NoisePreset> noise_presets();

}  // namespace patchlab
