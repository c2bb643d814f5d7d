#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/sensor/noise_model.h"
#include "engine/sensor/noise_presets.h"

namespace patchlab {
namespace {

template <class Noise>
struct Parameter {
  std::string_view name;
  double Noise::*value;
};
constexpr Parameter<StereoNoise> stereo_parameters[] = {{"f", &StereoNoise::f},
                                                        {"baseline", &StereoNoise::baseline},
                                                        {"pointing", &StereoNoise::pointing},
                                                        {"disparity", &StereoNoise::disparity}};
constexpr Parameter<LidarNoise> lidar_parameters[] = {{"range", &LidarNoise::range},
                                                      {"angle", &LidarNoise::angle}};

Error wrong(std::string_view specification, const std::string& what) {
  return {ErrorCode::usage, "Noise model '" + std::string(specification) + "': " + what};
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

std::optional<double> positive_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value) || value <= 0.0) return std::nullopt;
  return value;
}

std::string_view take_until(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view head = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
  return head;
}

using Kind = Result<decltype(NoiseModel::kind)>;

template <class Noise, std::size_t N>
Kind parse_parameters(std::string_view specification, std::string_view arguments,
                      const Parameter<Noise> (&parameters)[N]) {
  Noise noise;
  std::vector<std::string_view> seen;
  while (!arguments.empty()) {
    std::string_view number = take_until(arguments, ',');
    const std::string_view key = take_until(number, '=');
    const auto* parameter = std::ranges::find(parameters, key, &Parameter<Noise>::name);
    if (parameter == std::end(parameters)) {
      std::string names;
      for (const auto& one : parameters) names += (names.empty() ? "" : ", ") + std::string(one.name);
      return wrong(specification, "unknown parameter " + quoted(key) + "; the model takes " + names + ".");
    }
    if (std::ranges::find(seen, key) != seen.end())
      return wrong(specification, quoted(key) + " is given twice.");
    seen.push_back(key);
    const auto value = positive_number(number);
    if (!value) {
      return wrong(specification,
                   std::string(key) + " must be a positive number, not " + quoted(number) + ".");
    }
    noise.*(parameter->value) = *value;
  }
  return {noise};
}

Kind parse_stereo(std::string_view specification, std::string_view arguments) {
  return parse_parameters(specification, arguments, stereo_parameters);
}
Kind parse_lidar(std::string_view specification, std::string_view arguments) {
  return parse_parameters(specification, arguments, lidar_parameters);
}

Kind parse_isotropic(std::string_view specification, std::string_view arguments) {
  const auto sigma = positive_number(arguments);
  if (sigma) return {IsotropicNoise{*sigma}};
  return wrong(specification,
               "the standard deviation must be a positive number of metres, as in isotropic:0.002, not " +
                   quoted(arguments) + ".");
}

Kind parse_from_file(std::string_view specification, std::string_view arguments) {
  if (arguments.empty()) return {NoiseFromFile{}};
  return wrong(specification, "this model takes no parameters.");
}
Kind parse_preset(const NoisePreset& preset, std::string_view specification, std::string_view arguments) {
  if (arguments.empty()) return std::visit([](const auto& noise) { return Kind(noise); }, preset.noise);
  return wrong(specification, "this model takes no parameters; stereo and lidar do.");
}

struct ModelRow {
  std::string_view name;
  Kind (*parse)(std::string_view specification, std::string_view arguments);
  bool assumed;  // a specification that only a program writes
  std::string_view help;
};

constexpr ModelRow models[] = {
    {"from_file", parse_from_file, false,
     "from_file\n"
     "    The covariances the scan itself carries, one a point: six or nine entries, or standard deviations.\n"},
    {"stereo", parse_stereo, false,
     "stereo:f=525,baseline=0.075,pointing=0.35,disparity=0.17\n"
     "    Pointing and disparity errors of a stereo or structured-light camera. For a point p = (x, y, z) in "
     "the\n"
     "    sensor's frame, z forward:  Sigma = (z pointing/f)^2 diag(1, 1, 0) + (z disparity/(f baseline))^2 "
     "p p'.\n"
     "    f in pixels, baseline in metres, pointing and disparity are standard deviations in pixels.\n"
     "    Any parameter may be left out; the numbers shown are then used.\n"
     "    Source: Murray and Little, Environment Modeling with Stereo Vision (2004); Vona and Kanoulas "
     "(2011), IV.B.\n"},
    {"lidar", parse_lidar, false,
     "lidar:range=0.02,angle=0.00087\n"
     "    A laser scanner. For a point at range r in direction w:\n"
     "    Sigma = range^2 w w' + r^2 angle^2 (I - w w').\n"
     "    range is the standard deviation of a range in metres, angle that of a direction in radians.\n"
     "    Source: Yuan et al., VoxelMap (2022), 2 cm and 0.05 degrees for spinning lidars; take the maker's numbers "
     "instead.\n"},
    {"isotropic", parse_isotropic, false,
     "isotropic:0.002\n"
     "    The same standard deviation in every direction, in metres:  Sigma = sigma^2 I.\n"},
    {"estimated", parse_isotropic, true,
     "estimated:0.002\n"
     "    Isotropic, sigma estimated from the scan: the median standard deviation of the points about planes "
     "through\n"
     "    their neighbours. This is what is used, and marked as assumed, where nothing better is known.\n"},
};

std::string model_names() {
  std::string names;
  for (const ModelRow& row : models) names += std::string(row.name) + ", ";
  for (const NoisePreset& preset : noise_presets()) names += std::string(preset.name) + ", ";
  return names.substr(0, names.size() - 2);
}

}  // namespace

Result<NoiseModel> noise_model(std::string_view specification) {
  std::string_view arguments = specification;
  const std::string_view name = take_until(arguments, ':');
  const auto* row = std::ranges::find(models, name, &ModelRow::name);
  const auto presets = noise_presets();
  const auto preset = std::ranges::find(presets, name, &NoisePreset::name);
  if (row == std::end(models) && preset == presets.end()) {
    return wrong(specification, "there is no such model; the models are " + model_names() + ".");
  }
  const bool is_preset = row == std::end(models);
  const Kind kind =
      is_preset ? parse_preset(*preset, specification, arguments) : row->parse(specification, arguments);
  if (!kind) return kind.error();
  return NoiseModel{std::string(specification), *kind, !is_preset && row->assumed};
}

std::string noise_help() {
  std::string text = "Noise models (--noise), each the 3x3 covariance of a measured point:\n\n";
  for (const ModelRow& row : models) text += std::string(row.help) + "\n";
  text +=
      "Presets of depth cameras. The error of the depth z moves a point p along its ray, that of the pixel across the\n"
      "optical axis:  Sigma = sigma_z^2 (p/z)(p/z)' + lateral^2 diag(1, 1, 0), metres.\n\n";
  for (const NoisePreset& preset : noise_presets()) {
    text += std::string(preset.name) + "\n    " + std::string(preset.camera) + ":  " +
            std::string(preset.formula) + "\n    Source: " + std::string(preset.source) + "\n\n";
  }
  return text;
}

}  // namespace patchlab
