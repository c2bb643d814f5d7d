// A number of each point that its colour stands for: its height, its intensity, or how far
// noise spreads it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/project/document.h"

namespace patchlab::viewer {

struct PointScale {
  const char* title;  // with its unit
  // In that unit; not finite where the point has none.
  std::function<double(const ScanEntry& entry, std::size_t point)> value;
  double low = 0.0, high = 1.0;  // nearly all points that are shown lie between the two
};

// Heights along the unit vector `up`. Nothing where no finite point is shown.
std::optional<PointScale> height_scale(const Document& document, const Eigen::Vector3d& up);

// Nothing where no finite point that is shown has an intensity.
std::optional<PointScale> intensity_scale(const Document& document);

// Largest standard deviation of each point under a noise model, m; NaN where the point is not finite.
using Sigmas = std::shared_ptr<const std::vector<float>>;
Sigmas noise_sigmas(const Scan& scan, const NoiseModel& noise);
// `of` gives the sigmas of a scan; nullptr where they are not there yet.
std::optional<PointScale> noise_scale(const Document& document, std::function<Sigmas(const ScanEntry&)> of);

// Covariance of one point as a fit weighs it, m^2.
Eigen::Matrix3d point_covariance(const ScanEntry& entry, std::size_t point);

}  // namespace patchlab::viewer
