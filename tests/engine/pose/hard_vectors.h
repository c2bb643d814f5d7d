// Orientation vectors at which formulas for rotations fail: zero, denormal squares, series switches, and the
// cut at pi.
#pragma once

#include <numbers>
#include <vector>

#include "engine/pose/rotation.h"
#include "tests/support/seeded_random.h"

namespace patchlab::test {

inline std::vector<Vector3d> directions(Random& random) {
  std::vector<Vector3d> all = {Vector3d::UnitX(), -Vector3d::UnitY(), Vector3d::UnitZ(),
                               Vector3d(1, 1, 0).normalized(), Vector3d(1e-9, 1, -1e-5).normalized()};
  for (int i = 0; i < 3; ++i) all.push_back(random.unit3());
  return all;
}

inline std::vector<Vector3d> scaled(const std::vector<Vector3d>& directions,
                                    const std::vector<double>& lengths) {
  std::vector<Vector3d> all;
  for (const double length : lengths) {
    for (const Vector3d& direction : directions) all.push_back(length * direction);
  }
  return all;
}

// 0 <= |r| <= pi.
inline std::vector<Vector3d> canonical_vectors(Random& random) {
  constexpr double pi = std::numbers::pi;
  return scaled(directions(random), {0.0, 1e-160, 1e-20, 1e-8, 1e-4, 0.124, 0.126, 0.249, 0.251, 0.499, 0.501,
                                     1.0, 2.0, 3.0, pi - 1e-3, pi - 1e-6, pi - 1e-12, pi});
}

// Beyond pi, up to 30.
inline std::vector<Vector3d> long_vectors(Random& random) {
  return scaled(directions(random), {3.2, 5.0, 2.0 * std::numbers::pi, 8.0, 30.0});
}

inline std::vector<Vector3d> all_vectors(Random& random) {
  std::vector<Vector3d> all = canonical_vectors(random);
  for (const Vector3d& r : long_vectors(random)) all.push_back(r);
  return all;
}

// Errata section 9: tolerances grow with |r| beyond pi.
inline double growth(const Vector3d& r) { return std::max(1.0, r.norm() / std::numbers::pi); }

}  // namespace patchlab::test
