#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "engine/patch/surface.h"

namespace patchlab {
namespace {

constexpr int max_iterations = 200;
constexpr double infinity = std::numeric_limits<double>::infinity();

// What stays the same while the multiplier changes.
struct Problem {
  const Vector3d& q;
  const Matrix3d& S;
  const Vector3d& k3;
  Vector3d S_g;  // S g(q)
};

// The point x(lambda) with q - x = lambda S g(x): A (q - x) = lambda S g(q), A = I + 2 lambda S K. The
// eigenvalues of A are the 1 + 2 lambda mu_j of the whitened problem (method M2), so nothing has to be
// whitened and S may be semi-definite.
struct Stationary {
  bool inside = false;  // every eigenvalue of A is positive: x is the nearest point of its level set of f
  Vector3d offset;      // q - x
  Vector3d x;
  double f = 0.0;         // h(lambda) = f(x)
  double slope = 0.0;     // h'(lambda)
  double variance = 0.0;  // g(x)' S g(x)
};

Stationary stationary(const Problem& p, double lambda) {
  Matrix3d A = p.S * (2.0 * lambda * p.k3).asDiagonal();
  A.diagonal().array() += 1.0;
  Matrix3d A_inverse;
  double determinant = 0.0;
  bool invertible = false;
  A.computeInverseAndDetWithCheck(A_inverse, determinant, invertible, 0.0);
  Stationary at;
  if (!invertible) return at;
  // All roots of the characteristic polynomial are real: they are positive when its coefficients alternate.
  at.inside = A.trace() > 0.0 && determinant * A_inverse.trace() > 0.0 && determinant > 0.0;
  at.offset = lambda * (A_inverse * p.S_g);
  at.x = p.q - at.offset;
  at.f = implicit(at.x, p.k3);
  const Vector3d g = gradient(at.x, p.k3), S_g = p.S * g;
  at.slope = -g.dot(A_inverse * S_g);
  at.variance = g.dot(S_g);
  return at;
}

struct Solution {
  Stationary at;
  int iterations = 0;
  bool converged = false;
};

// The root of h in the interval around 0 where A is positive: Newton's method, halving the bracket where it
// leaves it.
Solution solve(const Vector3d& q, const Matrix3d& S, const Vector3d& k3) {
  const Vector3d g = gradient(q, k3);
  const Problem problem{q, S, k3, S * g};
  const double f0 = implicit(q, k3), sign = std::copysign(1.0, f0);
  Solution solution;
  double inside = 0.0, beyond = sign * infinity, lambda = f0 / g.dot(problem.S_g);
  for (bool last = false; std::isfinite(lambda) && solution.iterations < max_iterations;) {
    solution.at = stationary(problem, lambda);
    ++solution.iterations;
    if (last) break;
    const Stationary& at = solution.at;
    (at.inside && at.f * sign > 0.0 ? inside : beyond) = lambda;
    const double newton = lambda - at.f / at.slope;
    const bool bracketed = at.inside && (newton - inside) * sign >= 0.0 && (beyond - newton) * sign >= 0.0;
    const double next = bracketed ? newton : 0.5 * (inside + beyond);
    last = (at.inside && std::abs(at.f) <= 1e-9 * std::sqrt(at.variance)) ||
           std::abs(next - lambda) <= std::numeric_limits<double>::epsilon() * std::abs(lambda);
    lambda = next;
  }
  solution.converged = solution.at.inside && std::abs(solution.at.f) < 1e-9;
  return solution;
}

}  // namespace

FootPoint foot_point(const Vector3d& q_patch, const Matrix3d& cov_patch, const Vector3d& k3) {
  const double f = implicit(q_patch, k3);
  if (f == 0.0) return {q_patch, 0.0, 0};
  Solution solution = solve(q_patch, cov_patch, k3);
  if (!solution
           .converged) {  // between equally near points (a centre of curvature): a nudge chooses one of them
    const Vector3d direction(0.62, 0.51, 0.6), along = cov_patch * direction;
    const double sigma = std::sqrt(direction.dot(along));
    if (sigma > 0.0) solution = solve(q_patch + 1e-7 / sigma * along, cov_patch, k3);
  }
  if (!solution.converged) return {q_patch, std::copysign(infinity, f), solution.iterations};
  const double sigma = std::sqrt(solution.at.variance);
  return {solution.at.x, gradient(solution.at.x, k3).dot(solution.at.offset) / sigma, solution.iterations};
}

}  // namespace patchlab
