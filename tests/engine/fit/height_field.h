// Points of height fields for tests of the fit, and what they ask of its results.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/fit/fit_patch.h"
#include "engine/pose/rotation.h"

namespace patchlab::test {

// Points of a height field z(u) over |x|, |y| <= half, 1 m in front of a camera that looks along +z, turned
// by `tilt` about x, with isotropic noise.
struct Field {
  std::function<double(const Vector2d&)> height = [](const Vector2d&) { return 0.0; };
  Vector2d half = {0.1, 0.08};  // m
  double sigma = 1e-3;          // m
  double tilt = 0.3;            // rad
  std::size_t points = 300;
};

inline Observations observe(Random& random, const Field& field) {
  Observations observations;
  observations.optical_axis = Vector3d::UnitZ();
  const Matrix3d R = exp_map(Vector3d(field.tilt, 0.0, 0.0)) * exp_map(Vector3d(3.14159265358979, 0.0, 0.0));
  for (std::size_t i = 0; i < field.points; ++i) {
    const Vector2d u(random.uniform(-1.0, 1.0) * field.half.x(), random.uniform(-1.0, 1.0) * field.half.y());
    const Vector3d q = Vector3d(0.02, -0.03, 1.0) + R * Vector3d(u.x(), u.y(), field.height(u));
    observations.points.push_back(q + field.sigma * random.normal3());
    observations.covariances.push_back(field.sigma * field.sigma * Matrix3d::Identity());
  }
  return observations;
}

inline std::function<double(const Vector2d&)> bowl(double kx, double ky) {
  return [=](const Vector2d& u) { return 0.5 * (kx * u.x() * u.x() + ky * u.y() * u.y()); };
}

inline Result<FitResult> fit(const Observations& observations, SurfaceRequest surface) {
  FitOptions options;
  options.surface = surface;
  return fit_patch(observations, options);
}

inline const Finding* find(const std::vector<Finding>& findings, const std::string& name) {
  const auto at =
      std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.name == name; });
  return at == findings.end() ? nullptr : &*at;
}

}  // namespace patchlab::test
