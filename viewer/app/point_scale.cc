#include "viewer/app/point_scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/region/observe.h"

namespace patchlab::viewer {

namespace {

constexpr std::size_t most_asked = 20'000;  // points, for the ends of the scale
constexpr double beyond = 0.01;             // share of the points below and above what is coloured apart

Eigen::Matrix3d covariance_at(const Scan& scan, const NoiseModel& noise, std::size_t i) {
  if (!noise.from_file()) return covariance(noise, sensor_of(scan, i), scan.point(i));
  const Covariance6& c = scan.covariances[i];
  Eigen::Matrix3d cov;
  cov << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  return cov;
}

std::optional<PointScale> with_ends(const Document& document, PointScale scale) {
  std::vector<double> values;
  for (const ScanEntry& entry : document.scans) {
    if (!entry.visible || !entry.scan) continue;
    for (std::size_t i = 0; i < entry.scan->size(); i += 1 + entry.scan->size() / most_asked) {
      const double value = entry.scan->finite[i] ? scale.value(entry, i) : std::nan("");
      if (std::isfinite(value)) values.push_back(value);
    }
  }
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const auto few = static_cast<std::size_t>(beyond * static_cast<double>(values.size()));
  scale.low = values[few];
  scale.high = values[values.size() - 1 - few];
  return scale;
}

}  // namespace

std::optional<PointScale> height_scale(const Document& document, const Eigen::Vector3d& up) {
  const auto height = [up](const ScanEntry& entry, std::size_t i) { return up.dot(entry.scan->point(i)); };
  return with_ends(document, {"height, m", height});
}

std::optional<PointScale> intensity_scale(const Document& document) {
  const auto intensity = [](const ScanEntry& entry, std::size_t i) {
    const std::vector<float>& intensities = entry.scan->intensities;
    return intensities.empty() ? std::nan("") : static_cast<double>(intensities[i]);
  };
  return with_ends(document, {"intensity", intensity});
}

Sigmas noise_sigmas(const Scan& scan, const NoiseModel& noise) {
  auto sigmas = std::make_shared<std::vector<float>>(scan.size(), std::numeric_limits<float>::quiet_NaN());
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    solver.computeDirect(covariance_at(scan, noise, i), Eigen::EigenvaluesOnly);
    (*sigmas)[i] = static_cast<float>(std::sqrt(std::max(solver.eigenvalues()[2], 0.0)));
  }
  return sigmas;
}

std::optional<PointScale> noise_scale(const Document& document, std::function<Sigmas(const ScanEntry&)> of) {
  const auto sigma = [of = std::move(of)](const ScanEntry& entry, std::size_t i) {
    const Sigmas sigmas = of(entry);
    return sigmas ? 1e3 * static_cast<double>((*sigmas)[i]) : std::nan("");
  };
  return with_ends(document, {"noise σ, mm", sigma});
}

Eigen::Matrix3d point_covariance(const ScanEntry& entry, std::size_t point) {
  return covariance_at(*entry.scan, entry.noise, point);
}

}  // namespace patchlab::viewer
