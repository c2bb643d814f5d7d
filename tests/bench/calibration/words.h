// Types and numbers as the tables and plots write them.
#pragma once

#include <array>
#include <string>

#include "engine/patch/patch_type.h"
#include "tests/support/bands.h"

namespace patchlab::calibration {

struct Settings;

// The paraboloids of step 3, in the order of Table I.
inline constexpr std::array paraboloids = {
    SurfaceType::elliptic_paraboloid, SurfaceType::hyperbolic_paraboloid, SurfaceType::cylindric_paraboloid,
    SurfaceType::circular_paraboloid, SurfaceType::plane};

std::string words(SurfaceType surface);       // "circular cylinder"
std::string words(const PatchTypeRow& type);  // the same; planes with their boundary: "plane, convex quad"
std::string words(const Settings& settings);  // "N = 300 points, 400 trials a type, ..."

// Fixed digits after the point; "-" with its own glyph, an infinity as its sign, no number as a dash.
std::string fixed(double value, int digits);
std::string with_sign(double value, int digits);
// Three significant digits, for ratios that may be huge.
std::string ratio(double value);
std::string percent(double share, int digits);  // "95.0 %"
std::string percent(const test::Band& shares);  // "91.8–97.5 %"

}  // namespace patchlab::calibration
