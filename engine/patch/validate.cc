#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "engine/patch/patch.h"

namespace patchlab {
namespace {

using std::numbers::pi;
constexpr double slack = 1e-12;  // relative, on input (errata section 5)

// The reasons below are sentences' ends, "The sphere patch with a circle boundary ...", or empty.
using Reason = std::string;

Reason wrong_sizes(const Patch& patch) {
  const int n = patch.type->size();
  if (patch.parameters.size() != n) return "needs " + std::to_string(n) + " parameters.";
  for (const auto* covariance : {&patch.covariance, &patch.covariance_local}) {
    if (*covariance && ((*covariance)->rows() != n || (*covariance)->cols() != n)) {
      return "needs a covariance of " + std::to_string(n) + " rows and columns.";
    }
  }
  return {};
}

Reason not_finite(const Patch& patch) {
  if (patch.parameters.allFinite()) return {};
  const std::vector<std::string> names = parameter_names(*patch.type);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!std::isfinite(patch.parameters[static_cast<Eigen::Index>(i)]))
      return "has a " + names[i] + " that is not finite.";
  }
  return {};
}

Reason wrong_boundary(const Patch& patch) {
  const BoundaryVector d = boundary(patch).d;
  if (patch.type->boundary != BoundaryType::convex_quad) {
    return d.minCoeff() > 0.0 ? Reason{} : "has a boundary size that is not positive.";
  }
  if (d.head<4>().minCoeff() < 0.0) return "has a negative half-diagonal.";
  if (!(d[0] + d[2] > 0.0) || !(d[1] + d[3] > 0.0)) return "has a diagonal of length zero.";  // errata D11
  if (!(d[4] > 0.0) || !(d[4] < 0.5 * pi)) return "has a gamma outside 0 to pi/2.";
  return {};
}

Reason wrong_curvature(const Patch& patch) {
  const Eigen::VectorXd k = curvatures(patch);
  const BoundaryVector d = boundary(patch).d;
  switch (patch.type->surface) {
    case SurfaceType::elliptic_paraboloid:
      if (k[0] == 0.0 || k[1] == 0.0 || (k[0] > 0.0) != (k[1] > 0.0))
        return "needs two curvatures of the same sign.";
      return {};
    case SurfaceType::hyperbolic_paraboloid:
      if (k[0] == 0.0 || k[1] == 0.0 || (k[0] > 0.0) == (k[1] > 0.0))
        return "needs two curvatures of opposite signs.";
      return {};
    case SurfaceType::sphere:
    case SurfaceType::circular_cylinder:
      if (std::abs(k[0]) * d[d.size() - 1] > 1.0 + slack)
        return "reaches beyond its radius: |kappa| d is more than 1.";
      return {};
    default:
      return {};
  }
}

Reason wrong_rotation(const Patch& patch) {
  const double length = world_from_patch(patch).r.norm();
  return length <= pi * (1.0 + slack) ? Reason{} : "has an orientation vector longer than pi.";
}

// Symmetric and positive semi-definite after scaling to a correlation matrix.
Reason wrong_covariance(const std::optional<PatchMatrix>& covariance) {
  constexpr double tolerance = 1e-9;
  if (!covariance) return {};
  if (!covariance->allFinite()) return "has a covariance that is not finite.";
  if (covariance->diagonal().minCoeff() < 0.0) return "has a negative variance.";
  const PatchVector scale =
      covariance->diagonal().unaryExpr([](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 1.0; });
  const PatchMatrix scaled = scale.asDiagonal() * *covariance * scale.asDiagonal();
  if ((scaled - scaled.transpose()).cwiseAbs().maxCoeff() > tolerance)
    return "has a covariance that is not symmetric.";
  const PatchMatrix raised = scaled + tolerance * PatchMatrix::Identity(scaled.rows(), scaled.cols());
  if (Eigen::LLT<PatchMatrix>(raised).info() == Eigen::Success) return {};  // no eigenvalue below -tolerance
  const Eigen::SelfAdjointEigenSolver<PatchMatrix> solver(scaled, Eigen::EigenvaluesOnly);
  if (solver.eigenvalues()[0] < -tolerance) return "has a covariance that is not positive semi-definite.";
  return {};
}

Reason reason(const Patch& patch) {
  if (Reason why = wrong_sizes(patch); !why.empty()) return why;
  for (const auto check : {not_finite, wrong_boundary, wrong_curvature, wrong_rotation}) {
    if (Reason why = check(patch); !why.empty()) return why;
  }
  if (Reason why = wrong_covariance(patch.covariance); !why.empty()) return why;
  return wrong_covariance(patch.covariance_local);
}

}  // namespace

Result<void> validate(const Patch& patch) {
  if (!patch.type) return Error{ErrorCode::unreadable, "The patch has no type of Table I."};
  const Reason why = reason(patch);
  if (why.empty()) return {};
  return Error{ErrorCode::unreadable, "The patch (" + std::string(name(patch.type->surface)) + ", " +
                                          std::string(name(patch.type->boundary)) + ") " + why};
}

}  // namespace patchlab
