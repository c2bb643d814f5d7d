#include "viewer/panel/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace patchlab::viewer {

namespace {

struct Unit {
  const char* name;
  double size;  // in SI
};

Unit unit_of(double magnitude, Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return magnitude < 1.0 ? Unit{"mm", 1e-3} : Unit{"m", 1.0};
    case Dimension::angle:
      return magnitude < 0.1 ? Unit{"mrad", 1e-3} : Unit{"°", std::numbers::pi / 180.0};
    case Dimension::curvature:
      break;
  }
  return {"1/m", 1.0};
}

// Of the unit of a value; a smaller standard deviation has a unit of its own.
constexpr double least_in_unit = 0.01;

// Decimals that show `digits` significant digits of a number.
int decimals_of(double number, int digits) {
  if (number == 0.0 || !std::isfinite(number)) return digits - 1;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(number)))), 0, 6);
}

}  // namespace

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value));
  const bool all_zero = std::string(text).find_first_of("123456789") == std::string::npos;
  return std::signbit(value) && !all_zero ? "\u2212" + std::string(text) : text;
}

std::string significant(double value, int digits) { return fixed(value, decimals_of(value, digits)); }

Measured measured(double value, double sigma, Dimension dimension) {
  const Unit unit = unit_of(std::abs(value), dimension);
  const int decimals = sigma > 0 ? decimals_of(sigma / unit.size, 2) : 3;
  const bool of_its_size = sigma / unit.size >= least_in_unit;
  return {fixed(value / unit.size, decimals) + " " + unit.name,
          of_its_size ? "± " + significant(sigma / unit.size, 2) + " " + unit.name
                      : sigma_text(sigma, dimension)};
}

std::string sigma_text(double sigma, Dimension dimension) {
  const Unit unit = unit_of(sigma, dimension);
  return "± " + significant(sigma / unit.size, 2) + " " + unit.name;
}

std::string quantity(double value, Dimension dimension, int digits) {
  const Unit unit = unit_of(std::abs(value), dimension);
  return significant(value / unit.size, digits) + " " + unit.name;
}

std::string count(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string short_count(std::size_t number) {
  if (number < 10'000) return count(number);
  if (number < 1'000'000) return std::to_string((number + 500) / 1000) + "k";
  return significant(static_cast<double>(number) / 1e6, 2) + "M";
}

std::string duration(double seconds) {
  return seconds < 1.0 ? significant(seconds * 1e3, 2) + " ms" : significant(seconds, 2) + " s";
}

std::string size_words(std::uintmax_t bytes) {
  const double kilo = static_cast<double>(bytes) / 1e3;
  if (kilo < 1e3) return significant(kilo, 2) + " kB";
  return kilo < 1e6 ? significant(kilo / 1e3, 2) + " MB" : significant(kilo / 1e6, 2) + " GB";
}

std::string p_value_text(double p) { return p < 0.001 ? "p < 0.001" : "p " + fixed(p, p < 0.01 ? 3 : 2); }

}  // namespace patchlab::viewer
