#include "engine/sensor/noise_presets.h"

namespace patchlab {
namespace {

// A pixel coordinate that is known to the pixel: the deviation of a uniform error, 1/sqrt(12).
constexpr double one_pixel = 0.2887;

// Of an active stereo camera: focal length in pixels of its depth stream, baseline, sub-pixel deviation.
constexpr StereoNoise stereo(double f, double baseline, double disparity) {
  return {.f = f, .baseline = baseline, .pointing = one_pixel, .disparity = disparity};
}

constexpr std::string_view realsense_source =
    "Intel, sub-pixel white paper: sigma_z = z^2 s/(f baseline), f = width/2/tan(HFOV/2). Baseline and s = 0.08 px\n"
    "    are nominal and not checked on a device; lateral: 1/sqrt(12) px.";

constexpr NoisePreset presets[] = {
    {"kinect1", StereoNoise{}, "Microsoft Kinect, first generation",
     "the stereo model with the numbers above",
     "pointing and disparity from Vona and Kanoulas (2011), IV.B; f and baseline nominal."},
    {"khoshelham", DepthNoise{.quadratic = 0.001425, .lateral_z = one_pixel / 585.0},
     "Microsoft Kinect, first generation", "sigma_z = 0.001425 z^2, lateral 0.289 px z/585",
     "Khoshelham and Oude Elberink, Sensors 12(2), 2012, 1437-1454; lateral: 1/sqrt(12) px."},
    {"nguyen",
     DepthNoise{.constant = 0.0012, .quadratic = 0.0019, .nearest = 0.4, .lateral_z = 0.8175 / 585.0},
     "Microsoft Kinect, first generation, 0.4 m to 3 m",
     "sigma_z = 0.0012 + 0.0019 (z - 0.4)^2, lateral (0.8 + 0.035 t/(pi/2 - t)) px z/585",
     "Nguyen, Izadi and Lovell, 3DIMPVT 2012. The angle t between ray and surface is not known to a noise model:\n"
     "    t = 30 degrees is taken, and the axial form for surfaces seen under less than 60 degrees."},
    {"kinect2",
     DepthNoise{.constant = 0.0015,
                .linear = -0.0005,
                .quadratic = 0.0003,
                .power_1_5 = 0.000025,
                .lateral = 0.0016},
     "Microsoft Kinect v2, time of flight",
     "sigma_z = 0.0015 - 0.0005 z + 0.0003 z^2 + 0.0001 z^1.5 t^2/(pi/2 - t)^2, lateral 0.0016",
     "Fankhauser et al., ICAR 2015, coefficients as robots use them, not checked against the print; t = 30 degrees."},
    {"azure_kinect", DepthNoise{.constant = 0.017, .lateral_z = one_pixel / 504.0},
     "Microsoft Azure Kinect, time of flight", "sigma_z = 0.017, lateral 0.289 px z/504",
     "Microsoft's specification, random error of 17 mm at most, confirmed by Toelgyessy et al., Sensors 21(2), 2021,\n"
     "    413: a bound, near surfaces are better. The systematic error (11 mm + 0.1 %) is common to a scan and left out."},
    {"realsense_d415", stereo(1004.6, 0.055, 0.08), "Intel RealSense D415 at 1280 x 720",
     "the stereo model, f = 1004.6, baseline = 0.055, disparity = 0.08", realsense_source},
    {"realsense_d435", stereo(424.0, 0.050, 0.08), "Intel RealSense D435 at 848 x 480",
     "the stereo model, f = 424, baseline = 0.05, disparity = 0.08", realsense_source},
    {"realsense_d455", stereo(446.8, 0.095, 0.08), "Intel RealSense D455 at 848 x 480",
     "the stereo model, f = 446.8, baseline = 0.095, disparity = 0.08", realsense_source},
};

}  // namespace

std::span<const NoisePreset> noise_presets() { return presets; }

}  // namespace patchlab
