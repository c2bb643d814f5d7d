// Noise models: the 3x3 covariance of a measured point, from where it lies as the sensor sees it.
//
// A model is named by a specification, as written on the command line, in journals and in patch sets:
//   from_file                       the scan's own covariances
//   stereo:f=525,baseline=0.075,pointing=0.35,disparity=0.17   the paper's pointing/disparity model (Section
//   IV.B):
//                                   f px, baseline m, standard deviations in px; Sigma = J diag(p^2, p^2,
//                                   d^2) J'
//   kinect1                         the stereo model above with the paper's Kinect numbers
//   khoshelham nguyen kinect2 azure_kinect realsense_d435 ...   presets of depth cameras (noise_presets.h)
//   lidar:range=0.02,angle=0.00087  sigma of the range, m, and of the direction, rad:
//                                   Sigma = range^2 w w' + r^2 angle^2 (I - w w'), w the direction, r the
//                                   range
//   isotropic:0.002                 the same standard deviation in every direction, m
//   estimated:0.002                 isotropic, as default_noise_model found it in the scan; marked as assumed
// noise_help() lists each with its formula and the source of its numbers.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <variant>

#include "engine/base/result.h"
#include "engine/scan/scan.h"

namespace patchlab {

struct StereoNoise {
  double f = 525.0;         // focal length, px
  double baseline = 0.075;  // m
  double pointing = 0.35;   // standard deviation of a pixel coordinate, px
  double disparity = 0.17;  // standard deviation of a disparity, px
};
// A depth camera: the error of the depth moves a point along its ray, that of the pixel across the optical
// axis: Sigma = sigma_z^2 (p/z)(p/z)' + sigma_l^2 diag(1, 1, 0), where at depth z sigma_z = constant + linear
// z + quadratic (z - nearest)^2 + power_1_5 z^1.5, sigma_l = lateral + lateral_z z.
struct DepthNoise {
  double constant = 0.0, linear = 0.0, quadratic = 0.0, nearest = 0.0, power_1_5 = 0.0;  // m and powers of m
  double lateral = 0.0, lateral_z = 0.0;                                                 // m, and 1
};
struct LidarNoise {
  double range = 0.02;     // standard deviation of a range, m
  double angle = 0.00087;  // standard deviation of a direction about each of two axes, rad
};
struct IsotropicNoise {
  double sigma = 0.001;  // m
};
struct NoiseFromFile {};

struct NoiseModel {
  std::string specification;  // as asked for
  std::variant<StereoNoise, DepthNoise, LidarNoise, IsotropicNoise, NoiseFromFile> kind;
  bool assumed = false;  // true where nobody asked for it: said wherever it shows

  bool from_file() const { return std::holds_alternative<NoiseFromFile>(kind); }
};

// usage error for an unknown name or a number that is not positive and finite.
Result<NoiseModel> noise_model(std::string_view specification);
// Which model applies to a scan where none is asked for: from_file, kinect1 for
// organised clouds, else isotropic estimated from the scan's local roughness, each marked as assumed except
// from_file.
NoiseModel default_noise_model(const Scan& scan);

// Covariance of a point in the frame of the points, m^2; symmetric, positive semi-definite. Precondition: not
// from_file.
Eigen::Matrix3d covariance(const NoiseModel& model, const Viewpoint& viewpoint, const Eigen::Vector3d& point);
// The same of a sensor whose rotation is known already, for many points of one.
Eigen::Matrix3d covariance(const NoiseModel& model, const Eigen::Matrix3d& world_from_sensor,
                           const Eigen::Vector3d& sensor_position, const Eigen::Vector3d& point);
// The same in the sensor's optical frame (z forward), for the range camera.
Eigen::Matrix3d covariance_in_sensor(const NoiseModel& model, const Eigen::Vector3d& point_sensor);

// Text of `patchlab help noise`.
std::string noise_help();

}  // namespace patchlab
