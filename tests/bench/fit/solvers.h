// One fit each way: the same samples, the same start, the same stop.
#pragma once

#include "engine/fit/fit_surface.h"

namespace patchlab::bench {

// An eight-parameter paraboloid.
struct Solved {
  double chi2 = 0.0;
  Eigen::Matrix<double, 8, 8> cov;  // of the parameters, as each parametrises them
  Eigen::Vector3d apex = Eigen::Vector3d::Zero();
  int evaluations = 0;
};

// What both minimise: the paper's objective, Eq. (33), or the calibrated one with its prior.
struct Objective {
  Distance distance = Distance::paper;
  std::optional<VertexPrior> prior;
};

inline constexpr double stop = 1e-6;  // relative change of chi-square
inline constexpr int most_iterations = 100;

// Ours, its own start included.
SurfaceState quadratic_start(const Samples& samples);
Solved ours(const Samples& samples, const Objective& objective, double relative_stop = stop);

// Samples as Ceres's rows read them, one after the other.
struct Points {
  std::vector<Vector3d> q;    // m, about the origin of the samples
  std::vector<Matrix3d> cov;  // m^2
};
Points points_of(const Samples& samples);

// Of Ceres, from `start`; its making and that of the points are not timed.
enum class Ceres { normal_cholesky, qr, per_point };
bool has_ceres();
Solved ceres(Ceres way, const Points& points, const Objective& objective, const SurfaceState& start);

}  // namespace patchlab::bench
