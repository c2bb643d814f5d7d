// The residual of one sample and its derivatives in the local chart (method M2).
//
// Exact (calibrated): F is the signed Mahalanobis distance to the surface, by the foot point x:
//   F = g(x)'(q - x) / sqrt(g' S g),  F_p = f_p(x) / sqrt(g' S g),  F_q = g(x) / sqrt(g' S g)  (envelope
//   theorem)
// Paper: F = f(q) / sqrt(v_f), Eqs. (34)-(36), at the measured point.
#pragma once

#include <Eigen/Core>

#include "engine/fit/surface_model.h"

namespace patchlab {

enum class Distance { exact, paper };

struct Residual {
  double F = 0.0;   // in standard deviations
  ChartVector F_p;  // d F / d chart
  Vector3d F_q;     // d F / d q in local axes
  Vector3d x;       // foot point, local (exact); the sample itself (paper)
  Vector3d g;       // gradient at x
  double v = 1.0;   // g' S g
};

Residual residual(Distance distance, const SurfaceModel& model, const SurfaceState& state,
                  const Vector3d& q_world, const Matrix3d& cov_world);

// f_p of Eq. (40) in the chart at a local point: (B' q^2, g x q, -g).
ChartVector J_f_chart(const SurfaceModel& model, const Vector3d& q_local, const Vector3d& g);

}  // namespace patchlab
