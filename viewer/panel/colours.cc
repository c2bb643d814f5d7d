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

Rgba sequential(double t, ColourMap map) {
  // Nine points of each map, even steps apart.
  constexpr std::array<unsigned, 9> viridis = {0x440154, 0x472D7B, 0x3B528B, 0x2C728E, 0x21918C,
                                               0x28AE80, 0x5EC962, 0xADDC30, 0xFDE725};
  constexpr std::array<unsigned, 9> cividis = {0x00224E, 0x1D3A6B, 0x43506C, 0x61666F, 0x7C7B78,
                                               0x989175, 0xB7A96B, 0xDAC257, 0xFEE838};
  const std::array<unsigned, 9>& points = map == ColourMap::viridis ? viridis : cividis;
  const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(points.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), points.size() - 2);
  return mix(rgb(points[below]), rgb(points[below + 1]), static_cast<float>(at - static_cast<double>(below)));
}

Rgba diverging(double t, double neutral_lightness) {
  t = std::clamp(t, -1.0, 1.0);
  const double strength = std::abs(t);
  return oklch(between(neutral_lightness, 0.66, strength), 0.15 * strength, t < 0 ? 240.0 : 52.0);
}

Rgba rgba(const Colour& colour) {
  const auto part = [&](std::size_t k) { return static_cast<float>(colour[k]) / 255.0f; };
  return {part(0), part(1), part(2), 1.0f};
}

Rgba category_colour(const std::string& id) {
  const std::size_t digits = id.find_last_not_of("0123456789") + 1;
  const unsigned long number = digits < id.size() ? std::strtoul(id.c_str() + digits, nullptr, 10) : 1;
  return rgba(okabe_ito[(number + okabe_ito.size() - 1) % okabe_ito.size()]);
}

Rgba colour_of(const RegionEntry& region) {
  return region.colour ? rgba(*region.colour) : category_colour(region.id);
}

Rgba colour_of(const PatchEntry& patch) {
  return patch.colour ? rgba(*patch.colour) : category_colour(patch.region);
}

}  // namespace patchlab::viewer
