#include "engine/fit/distance.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "engine/patch/surface.h"

namespace patchlab {
namespace {

// footnote 10: a semi-definite covariance is clamped so that the weight stays finite.
double clamped(double v, const Matrix3d& cov, const Vector3d& g) {
  return std::max(v, 1e-12 * cov.trace() * g.squaredNorm() + std::numeric_limits<double>::min());
}

Residual exact_residual(const SurfaceModel& model, const Vector3d& kappa, const Vector3d& q,
                        const Matrix3d& S) {
  Residual r;
  const FootPoint foot = foot_point(q, S, kappa);
  r.x = foot.x;
  r.g = gradient(foot.x, kappa);  // Eq. (39)
  r.v = clamped(r.g.dot(S * r.g), S, r.g);
  const double s = std::sqrt(r.v);
  r.F = r.g.dot(q - foot.x) / s;
  r.F_p = J_f_chart(model, foot.x, r.g) / s;
  r.F_q = r.g / s;  // first order: sigma_i held, so that F_q S F_q' = 1
  return r;
}

Residual paper_residual(const SurfaceModel& model, const Vector3d& kappa, const Vector3d& q,
                        const Matrix3d& S) {
  Residual r;
  r.x = q;
  r.g = gradient(q, kappa);
  const Vector3d Sg = S * r.g;
  r.v = clamped(r.g.dot(Sg), S, r.g);  // Eq. (34)
  const double s = std::sqrt(r.v);
  r.F = implicit(q, kappa) / s;  // Eq. (35)
  const PatchTypeRow& row = *find_patch_type(model.surface, default_boundary(model.surface));
  const Vector3d KSg = 2.0 * kappa.cwiseProduct(Sg);
  ChartVector half_v_p = ChartVector::Zero();  // g_p' S g, the second term of Eq. (36)
  half_v_p.head(model.curvatures) = row.B.transpose() * (2.0 * q.cwiseProduct(Sg));
  half_v_p.segment<3>(2) = KSg.cross(q) - Sg.cross(r.g);
  half_v_p.segment<3>(5) = -KSg;
  r.F_p = J_f_chart(model, q, r.g) / s - (r.F / r.v) * half_v_p;  // Eq. (36)
  r.F_q = r.g / s;  // first order: sigma_i held, so that F_q S F_q' = 1
  return r;
}

}  // namespace

ChartVector J_f_chart(const SurfaceModel& model, const Vector3d& q_local, const Vector3d& g) {
  ChartVector f_p = ChartVector::Zero();
  const PatchTypeRow& row = *find_patch_type(model.surface, default_boundary(model.surface));
  f_p.head(model.curvatures) = row.B.transpose() * q_local.cwiseAbs2();
  f_p.segment<3>(2) = g.cross(q_local);
  f_p.segment<3>(5) = -g;
  return f_p;
}

Residual residual(Distance distance, const SurfaceModel& model, const SurfaceState& state,
                  const Vector3d& q_world, const Matrix3d& cov_world) {
  const Vector3d q = to_local(state, q_world);
  const Matrix3d S = state.R.transpose() * cov_world * state.R;
  const Vector3d kappa = k3(model, state.k);
  return distance == Distance::exact ? exact_residual(model, kappa, q, S)
                                     : paper_residual(model, kappa, q, S);
}

}  // namespace patchlab
