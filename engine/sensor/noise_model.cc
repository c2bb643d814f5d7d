#include "engine/sensor/noise_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "engine/sensor/roughness.h"

namespace patchlab {
namespace {

constexpr double roughness_where_unknown = 0.001;  // m
constexpr double smallest_estimate = 1e-6;         // m: also for points that lie exactly on their surface

struct StereoParameter {
  std::string_view name;
  double StereoNoise::*value;
};
constexpr StereoParameter stereo_parameters[] = {{"f", &StereoNoise::f},
                                                 {"baseline", &StereoNoise::baseline},
                                                 {"pointing", &StereoNoise::pointing},
                                                 {"disparity", &StereoNoise::disparity}};

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

Kind parse_stereo(std::string_view specification, std::string_view arguments) {
  StereoNoise noise;
  std::vector<std::string_view> seen;
  while (!arguments.empty()) {
    std::string_view number = take_until(arguments, ',');
    const std::string_view key = take_until(number, '=');
    const auto* parameter = std::ranges::find(stereo_parameters, key, &StereoParameter::name);
    if (parameter == std::end(stereo_parameters)) {
      return wrong(specification, "unknown parameter " + quoted(key) +
                                      "; the stereo model takes f, baseline, pointing and disparity.");
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

Kind parse_isotropic(std::string_view specification, std::string_view arguments) {
  const auto sigma = positive_number(arguments);
  if (sigma) return {IsotropicNoise{*sigma}};
  return wrong(specification,
               "the standard deviation must be a positive number of metres, as in isotropic:0.002, not " +
                   quoted(arguments) + ".");
}

Kind parse_plain(std::string_view specification, std::string_view arguments,
                 decltype(NoiseModel::kind) kind) {
  if (arguments.empty()) return {kind};
  return wrong(specification, "this model takes no parameters.");
}
Kind parse_kinect1(std::string_view specification, std::string_view arguments) {
  return parse_plain(specification, arguments, StereoNoise{});
}
Kind parse_from_file(std::string_view specification, std::string_view arguments) {
  return parse_plain(specification, arguments, NoiseFromFile{});
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
     "    The covariances the scan itself carries, one a point.\n"},
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
    {"kinect1", parse_kinect1, false,
     "kinect1\n"
     "    The stereo model with the numbers above, the first Kinect: sigma along the ray 4.3 mm at 1 m, 17 "
     "mm at 2 m.\n"
     "    Source: pointing and disparity from Vona and Kanoulas (2011), IV.B; f and baseline nominal.\n"},
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
  for (const ModelRow& row : models) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

NoiseModel assumed_model(std::string specification) {
  NoiseModel model = *noise_model(specification);
  model.assumed = true;
  return model;
}

// Three digits: enough for an estimate, and the model is exactly what its specification says.
std::string estimated_specification(double sigma) {
  char digits[32];
  const auto [end, error] =
      std::to_chars(digits, digits + sizeof digits, sigma, std::chars_format::general, 3);
  return "estimated:" + std::string(digits, end);
}

Eigen::Matrix3d stereo_covariance(const StereoNoise& noise, const Eigen::Vector3d& p) {
  // Sigma = J diag(pointing^2, pointing^2, disparity^2) J' of Section IV.B, with x/z = u/f and y/z = v/f put
  // in: the third column of J is -z/(f baseline) p, the ray itself, and nothing is divided by z.
  const double lateral = p.z() * noise.pointing / noise.f;
  const double along_ray = p.z() * noise.disparity / (noise.f * noise.baseline);
  Eigen::Matrix3d cov = (along_ray * along_ray) * p * p.transpose();
  cov.diagonal().head<2>().array() += lateral * lateral;
  return cov;
}

}  // namespace

Result<NoiseModel> noise_model(std::string_view specification) {
  std::string_view arguments = specification;
  const std::string_view name = take_until(arguments, ':');
  const auto* row = std::ranges::find(models, name, &ModelRow::name);
  if (row == std::end(models)) {
    return wrong(specification, "there is no such model; the models are " + model_names() + ".");
  }
  const Kind kind = row->parse(specification, arguments);
  if (!kind) return kind.error();
  return NoiseModel{std::string(specification), *kind, row->assumed};
}

NoiseModel default_noise_model(const Scan& scan) {
  if (!scan.covariances.empty()) return {"from_file", NoiseFromFile{}, false};
  if (scan.organized()) return assumed_model("kinect1");
  const double sigma = local_roughness(scan).value_or(roughness_where_unknown);
  return assumed_model(estimated_specification(std::max(sigma, smallest_estimate)));
}

Eigen::Matrix3d covariance(const NoiseModel& model, const Viewpoint& viewpoint,
                           const Eigen::Vector3d& point) {
  const Eigen::Matrix3d world_from_sensor = rotation(viewpoint);
  const Eigen::Vector3d point_sensor = world_from_sensor.transpose() * (point - viewpoint.position);
  const Eigen::Matrix3d cov =
      world_from_sensor * covariance_in_sensor(model, point_sensor) * world_from_sensor.transpose();
  return 0.5 * (cov + cov.transpose());
}

Eigen::Matrix3d covariance_in_sensor(const NoiseModel& model, const Eigen::Vector3d& point_sensor) {
  if (const auto* stereo = std::get_if<StereoNoise>(&model.kind))
    return stereo_covariance(*stereo, point_sensor);
  const double sigma = std::get<IsotropicNoise>(model.kind).sigma;
  return sigma * sigma * Eigen::Matrix3d::Identity();
}

std::string noise_help() {
  std::string text = "Noise models (--noise), each the 3x3 covariance of a measured point:\n\n";
  for (const ModelRow& row : models) text += std::string(row.help) + "\n";
  return text;
}

}  // namespace patchlab
