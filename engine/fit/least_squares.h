// Nonlinear least squares by Levenberg-Marquardt. The solver knows no patch: a Problem tells it
//
//   using State = ...;                        what is sought: a vector, or a point of a manifold
//   NormalEquations evaluate(const State&)    cost, gradient and Gauss-Newton matrix there
//   State retract(const State&, step)         the state moved by a step of the local chart
//
// The cost is sum rho(F_i^2) (chi-square where rho is the identity), A = sum w_i F_p' F_p, b = sum w_i F_p'
// F.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/fit/cholesky.h"

namespace patchlab {

struct NormalEquations {
  double cost = 0.0;
  StepMatrix A;
  StepVector b;
  double chi2 = 0.0;  // of the data alone, where the cost holds a loss or a prior too; carried along

  void operator+=(const NormalEquations& other) {
    cost += other.cost;
    A += other.A;
    b += other.b;
    chi2 += other.chi2;
  }
};

struct LeastSquaresOptions {
  int max_iterations = 100;
  double stop = 1e-10;  // step' A step: the step in units of the result's own standard deviations, squared
  double initial_damping = 1e-3;          // relative to the diagonal of A
  std::function<bool()> keep_going = {};  // asked before each step; false ends it where it is
};

struct LeastSquaresSummary {
  bool converged = false;
  int iterations = 0;           // accepted and refused steps
  int evaluations = 0;          // of the problem: one fewer where the last step was not measured
  NormalEquations at_solution;  // A, b there or one step of no consequence before
};

// A damped step solves (A + damping D) step = -b. Three rules guide it:
//
// Scaling (More): D is the largest diagonal of A met so far. Each parameter is measured in units of its own
// information, and one that has drifted to where the data hardly see it is still held by the scale it had;
// with the present diagonal alone its damping would vanish just when it is needed.
//
// Sight: a step that takes nearly all information from some parameter is refused even where it lowers the
// cost: the model has been thrown onto a plateau, from which no gradient leads back.
//
// Damping (Nielsen): it falls as far as the step's gain agrees with the prediction, and grows faster with
// each refusal in a row.
//
// Converged when a nearly undamped step is below `stop`: it is taken unmeasured, the cost lowered by its
// prediction. Also when no step of any damping is accepted.
template <class Problem>
LeastSquaresSummary minimise(const Problem& problem, typename Problem::State& state,
                             const LeastSquaresOptions& options = {}) {
  constexpr double least_sight = 0.01;  // share of its information that a parameter keeps in one step
  constexpr double steepest_fall = 0.2, first_growth = 2.0, largest_damping = 1e12;
  LeastSquaresSummary summary;
  NormalEquations here = problem.evaluate(state);
  summary.evaluations = 1;
  StepVector scale = StepVector::Zero(here.b.size());
  double damping = options.initial_damping, growth = first_growth;
  while (!summary.converged && summary.iterations < options.max_iterations && std::isfinite(here.cost) &&
         (!options.keep_going || options.keep_going())) {
    ++summary.iterations;
    const StepVector information = here.A.diagonal();
    scale = scale.cwiseMax(information).cwiseMax(1e-30 * information.maxCoeff());
    StepMatrix damped = here.A;
    damped.diagonal() += damping * scale;
    const StepVector step = -solve_positive(damped, here.b);
    const double damped_length = damping * step.cwiseAbs2().dot(scale);
    const double length = -step.dot(here.b) - damped_length;  // step' A step
    const double predicted = length + 2.0 * damped_length;
    auto candidate = problem.retract(state, step);
    if (length < options.stop && damping < 1.0) {
      state = std::move(candidate);
      here.cost = std::max(here.cost - predicted, 0.0);
      here.chi2 = std::max(here.chi2 - predicted, 0.0);
      summary.converged = true;
      break;
    }
    NormalEquations there = problem.evaluate(candidate);
    ++summary.evaluations;
    const bool in_sight = (there.A.diagonal().array() >= least_sight * information.array()).all();
    if (in_sight && std::isfinite(there.cost) && there.cost <= here.cost) {
      const double gain = (here.cost - there.cost) / predicted, agreement = 2.0 * gain - 1.0;
      state = std::move(candidate);
      here = std::move(there);
      damping *= std::max(steepest_fall, 1.0 - agreement * agreement * agreement);
      growth = first_growth;
    } else {
      summary.converged = length < 1e-3 * options.stop || damping > largest_damping;
      damping *= growth;
      growth *= 2.0;
    }
  }
  summary.at_solution = std::move(here);
  return summary;
}

}  // namespace patchlab
