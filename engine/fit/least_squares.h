// Nonlinear least squares by Levenberg-Marquardt. The solver knows no patch: a Problem tells it
//
//   using State = ...;                        what is sought: a vector, or a point of a manifold
//   NormalEquations evaluate(const State&)    cost, gradient and Gauss-Newton matrix there
//   State retract(const State&, step)         the state moved by a step of the local chart
//
// The cost is sum rho(F_i^2) (chi-square where rho is the identity), A = sum w_i F_p' F_p, b = sum w_i F_p'
// F.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <utility>

namespace patchlab {

// At most 9 parameters on the stack: no allocation inside a fit.
using StepVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
using StepMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;

struct NormalEquations {
  double cost = 0.0;
  StepMatrix A;
  StepVector b;
};

struct LeastSquaresOptions {
  int max_iterations = 100;
  double stop = 1e-10;  // step' A step: the step in units of the result's own standard deviations, squared
  double initial_damping = 1e-3;  // relative to the diagonal of A
};

struct LeastSquaresSummary {
  bool converged = false;
  int iterations = 0;  // accepted and refused steps
  NormalEquations at_solution;
};

// Marquardt's scaling, Nielsen's damping. Converged when the undamped step is below `stop`, or when no step
// of any damping lowers the cost any more.
template <class Problem>
LeastSquaresSummary minimise(const Problem& problem, typename Problem::State& state,
                             const LeastSquaresOptions& options = {}) {
  LeastSquaresSummary summary;
  NormalEquations here = problem.evaluate(state);
  double damping = options.initial_damping, growth = 2.0;
  constexpr double largest_damping = 1e12;
  while (summary.iterations < options.max_iterations && std::isfinite(here.cost)) {
    ++summary.iterations;
    const StepVector scale = here.A.diagonal().cwiseMax(1e-30 * here.A.diagonal().maxCoeff());
    const StepMatrix damped = here.A + StepMatrix((damping * scale).asDiagonal());
    const StepVector step = -damped.ldlt().solve(here.b);
    const double length = step.dot(here.A * step);
    const double predicted = step.dot(damping * scale.cwiseProduct(step) - here.b);
    auto candidate = problem.retract(state, step);
    NormalEquations there = problem.evaluate(candidate);
    const double gain = (here.cost - there.cost) / predicted;
    if (there.cost <= here.cost && std::isfinite(there.cost)) {
      state = std::move(candidate);
      here = std::move(there);
      damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
      damping = std::max(damping, 1e-15);
      growth = 2.0;
      summary.converged = length < options.stop && damping < 1.0;
    } else {
      damping *= growth;
      growth *= 2.0;
      summary.converged = length < 1e-3 * options.stop || damping > largest_damping;
    }
    if (summary.converged) break;
  }
  summary.at_solution = std::move(here);
  return summary;
}

}  // namespace patchlab
