#include "viewer/panel/colours.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace patchlab::viewer {

namespace {

double linear_from_srgb(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

double srgb_from_linear(double l) {
  const double s = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
  return std::clamp(s, 0.0, 1.0);
}

double luminance(const Rgba& c) {
  return 0.2126 * linear_from_srgb(c[0]) + 0.7152 * linear_from_srgb(c[1]) + 0.0722 * linear_from_srgb(c[2]);
}

double between(double from, double to, double part) { return from + (to - from) * part; }

}  // namespace

Rgba rgb(unsigned hex, float alpha) {
  const auto channel = [hex](int shift) { return static_cast<float>((hex >> shift) & 0xff) / 255.0f; };
  return {channel(16), channel(8), channel(0), alpha};
}

Rgba with_alpha(const Rgba& colour, float alpha) { return {colour[0], colour[1], colour[2], alpha}; }

Rgba mix(const Rgba& from, const Rgba& to, float part) {
  Rgba mixed;
  for (std::size_t i = 0; i < 4; ++i) mixed[i] = from[i] + (to[i] - from[i]) * part;
  return mixed;
}

Rgba8 to_bytes(const Rgba& colour) {
  Rgba8 bytes;
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[i] = static_cast<std::uint8_t>(std::lround(std::clamp(colour[i], 0.0f, 1.0f) * 255.0f));
  }
  return bytes;
}

double contrast(const Rgba& one, const Rgba& other) {
  const double a = luminance(one) + 0.05, b = luminance(other) + 0.05;
  return std::max(a, b) / std::min(a, b);
}

Rgba oklch(double lightness, double chroma, double hue) {
  const double radians = hue * std::numbers::pi / 180.0;
  const double a = chroma * std::cos(radians), b = chroma * std::sin(radians);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {static_cast<float>(srgb_from_linear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
          static_cast<float>(srgb_from_linear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
          static_cast<float>(srgb_from_linear(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)),
          1.0f};
}

Rgba sequential(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return oklch(between(0.34, 0.91, t), between(0.105, 0.16, t * t), between(288.0, 106.0, t));
}

Rgba diverging(double t, double neutral_lightness) {
  t = std::clamp(t, -1.0, 1.0);
  const double strength = std::abs(t);
  return oklch(between(neutral_lightness, 0.66, strength), 0.15 * strength, t < 0 ? 240.0 : 52.0);
}

Rgba category_colour(const std::string& id) {
  constexpr std::array<unsigned, 7> okabe_ito = {0xE69F00, 0x56B4E9, 0xCC79A7, 0x009E73,
                                                 0xF0E442, 0xD55E00, 0x0072B2};
  const std::size_t digits = id.find_last_not_of("0123456789") + 1;
  const unsigned long number = digits < id.size() ? std::strtoul(id.c_str() + digits, nullptr, 10) : 1;
  return rgb(okabe_ito[(number + okabe_ito.size() - 1) % okabe_ito.size()]);
}

}  // namespace patchlab::viewer
