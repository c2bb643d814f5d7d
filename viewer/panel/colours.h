// Colours: conversions, the colour maps, and the colours of patches. Equal steps of a value are equal steps
// to the eye, and lightness alone carries the order, so that colour-blind users read them too.
#pragma once

#include <array>
#include <string>

#include "engine/project/document.h"
#include "viewer/render/scene.h"

namespace patchlab::viewer {

// 0xRRGGBB.
Rgba rgb(unsigned hex, float alpha = 1.0f);
Rgba with_alpha(const Rgba& colour, float alpha);
Rgba mix(const Rgba& from, const Rgba& to, float part);
Rgba8 to_bytes(const Rgba& colour);

// WCAG 2 contrast ratio of two opaque colours, 1..21.
double contrast(const Rgba& one, const Rgba& other);

// OKLab by lightness, chroma and hue (degrees), clipped to sRGB.
Rgba oklch(double lightness, double chroma, double hue);

// From dark to light, t in [0, 1]: magnitudes such as the standard deviation of a height. Viridis goes from
// violet through teal to yellow, cividis from blue through grey to yellow: alike to every colour-blind eye.
enum class ColourMap { viridis, cividis };
Rgba sequential(double t, ColourMap map = ColourMap::viridis);
// Blue through neutral to orange, t in [-1, 1]: signed values such as correlations and residuals.
// `neutral_lightness` suits the ground it lies on.
Rgba diverging(double t, double neutral_lightness);

// Okabe and Ito's colours for categories; of an id, by the number at its end ("region-3").
inline constexpr std::array<Colour, 7> okabe_ito = {{{0xE6, 0x9F, 0x00},
                                                     {0x56, 0xB4, 0xE9},
                                                     {0xCC, 0x79, 0xA7},
                                                     {0x00, 0x9E, 0x73},
                                                     {0xF0, 0xE4, 0x42},
                                                     {0xD5, 0x5E, 0x00},
                                                     {0x00, 0x72, 0xB2}}};
Rgba rgba(const Colour& colour);
Rgba category_colour(const std::string& id);
// As somebody chose it, or of the region's id.
Rgba colour_of(const RegionEntry& region);
Rgba colour_of(const PatchEntry& patch);

}  // namespace patchlab::viewer
