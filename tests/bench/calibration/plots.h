// The plots of the calibration report, one SVG file each.
#pragma once

#include <string>
#include <string_view>

#include "tests/bench/calibration/study.h"

namespace patchlab::calibration {

inline constexpr std::string_view surface_probability_file = "probability_surface.svg",
                                  full_probability_file = "probability_full.svg",
                                  coverage_file = "coverage.svg", bounds_file = "bounds.svg",
                                  starts_file = "starts.svg";

// A panel a type: the share of trials whose NEES lies inside the ellipsoid of each probability. True: the
// diagonal.
std::string surface_probability_plot(const Study& study);
std::string full_probability_plot(const Study& study);
// Bars: the share of trials inside the 95 % ellipsoid, of the surface and of all parameters.
std::string coverage_plot(const Study& study);
// Dots: d / d_true with the standard deviation of one fit.
std::string bounds_plot(const Study& study);
// Success of the cylinder's fit against the angle of its start.
std::string starts_plot(const Study& study);

}  // namespace patchlab::calibration
