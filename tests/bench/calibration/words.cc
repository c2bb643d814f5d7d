#include "tests/bench/calibration/words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/bench/calibration/study.h"

namespace patchlab::calibration {
namespace {

std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string printed(const char* format, int digits, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, digits, value);
  return text;
}

}  // namespace

std::string words(SurfaceType surface) { return spaced(name(surface)); }

std::string words(const PatchTypeRow& type) {
  if (type.surface != SurfaceType::plane) return words(type.surface);
  return "plane, " + spaced(name(type.boundary));
}

std::string words(const Settings& settings) {
  const bool linear = settings.noise == test::NoiseMode::linear;
  return "N = " + std::to_string(settings.points) + " points, " + std::to_string(settings.trials) +
         " trials a type, " + (linear ? "noise linear in x, y, z" : "noise of pixel and disparity") +
         ", seed " + std::to_string(settings.seed);
}

std::string fixed(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0.0 ? "∞" : "−∞";
  std::string text = value < 0.0 ? "−" : "";
  return text.append(printed("%.*f", digits, std::abs(value)));
}

std::string with_sign(double value, int digits) {
  std::string text = value >= 0.0 ? "+" : "";
  return text.append(fixed(value, digits));
}

std::string ratio(double value) {
  if (!std::isfinite(value)) return fixed(value, 0);
  if (std::abs(value) >= 1e4) return printed("%.*g", 2, value);
  return fixed(value, std::abs(value) >= 100.0 ? 0 : std::abs(value) >= 10.0 ? 1 : 2);
}

std::string percent(double share, int digits) { return fixed(100.0 * share, digits) + " %"; }

std::string percent(const test::Band& shares) {
  return fixed(100.0 * shares.low, 1) + "–" + fixed(100.0 * shares.high, 1) + " %";
}

}  // namespace patchlab::calibration
