// Noise models: the 3x3 covariance of a measured point, from where it lies as the sensor sees it.
//
// A model is named by a specification, as written on the command line, in journals and in patch sets:
//   from_file                       the scan's own covariances
//   stereo:f=525,baseline=0.075,pointing=0.35,disparity=0.17   the paper's pointing/disparity model (Section
//   IV.B):
//                                   f px, baseline m, standard deviations in px; Sigma = J diag(p^2, p^2,
//                                   d^2) J'
//   kinect1                         the stereo model above with the paper's Kinect numbers
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
struct IsotropicNoise {
  double sigma = 0.001;  // m
};
struct NoiseFromFile {};

struct NoiseModel {
  std::string specification;  // as asked for
  std::variant<StereoNoise, IsotropicNoise, NoiseFromFile> kind;
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
// The same in the sensor's optical frame (z forward), for the range camera.
Eigen::Matrix3d covariance_in_sensor(const NoiseModel& model, const Eigen::Vector3d& point_sensor);

// Text of `patchlab help noise`.
std::string noise_help();

}  // namespace patchlab
