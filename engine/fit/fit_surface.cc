#include "engine/fit/fit_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/fit/foot_points.h"
#include "engine/fit/sample_rows.h"
#include "engine/patch/surface.h"

namespace patchlab {
namespace {

constexpr double tukey_constant = 4.685;  // 95 % efficiency on clean normal data
constexpr int trial_iterations = 6;       // of each of several starts, before the best goes on
constexpr double during_fits = 0.4;       // of a whole fit, as progress says it

double tukey_loss(double F) {
  const double inside = 1.0 - std::min(F * F / (tukey_constant * tukey_constant), 1.0);
  return tukey_constant * tukey_constant / 3.0 * (1.0 - inside * inside * inside);
}

bool counts(const Samples& samples, std::size_t i) {
  return samples.robust[i] != 0.0 && samples.bends[i] != 0;
}

// Rows of 0 where a sample does not count, whatever was there.
void set_aside(const Samples& samples, std::size_t first, std::size_t count, RowBlock& rows) {
  for (std::size_t i = 0; i < count; ++i) {
    if (counts(samples, first + i)) continue;
    for (auto& row : rows.row) row[i] = 0.0;
  }
}

// Rows of a block as the sums are to take them by robust weights: scaled by their root. The loss and
// chi-square of those that count.
struct Losses {
  double cost = 0.0, chi2 = 0.0;

  void operator+=(const Losses& other) {
    cost += other.cost;
    chi2 += other.chi2;
  }
};
Losses weigh(const Samples& samples, const SurfaceFitOptions& options, std::size_t first, std::size_t count,
             RowBlock& rows) {
  double scale[block_size];
  Losses losses;
  for (std::size_t i = 0; i < count; ++i) {
    scale[i] = 0.0;
    if (!counts(samples, first + i)) continue;
    const double F = rows.row[chart_size][i], sigma = options.robust_scale;
    scale[i] = std::sqrt(tukey_weight(F / sigma));
    losses.cost += sigma * sigma * tukey_loss(F / sigma);
    losses.chi2 += F * F;
  }
  for (auto& row : rows.row) {
    for (std::size_t i = 0; i < count; ++i) row[i] = scale[i] > 0.0 ? scale[i] * row[i] : 0.0;
  }
  return losses;
}

// The problem that engine/fit/least_squares.h solves, Eq. (33), with the prior as two more residuals.
class SurfaceProblem {
 public:
  using State = SurfaceState;

  SurfaceProblem(const Samples& samples, const SurfaceModel& model, const SurfaceFitOptions& options,
                 const std::optional<VertexPrior>& prior)
      : samples_(samples),
        model_(model),
        options_(options),
        prior_(prior),
        all_count_(samples.all_count(0, samples.size())) {}

  NormalEquations evaluate(const SurfaceState& state) const {
    const SampleRows rows(samples_, model_, state, options_.distance);
    NormalEquations equations =
        sum_of_parts(rows.blocks(), [&](const Chunk& part) { return of_part(rows, part); });
    if (prior_) add_prior(state, equations);
    return equations;
  }

  SurfaceState retract(const SurfaceState& state, const StepVector& step) const {
    return patchlab::retract(state, spread(model_, step));
  }

 private:
  NormalEquations of_part(const SampleRows& rows, const Chunk& part) const {
    RowSums sums;
    RowBlock block;
    Losses losses;
    for (std::size_t b = part.first; b < part.last; ++b) {
      rows.evaluate(b, block);
      if (options_.robust) {
        losses += weigh(samples_, options_, b * block_size, rows.count(b), block);
      } else if (!all_count_) {
        set_aside(samples_, b * block_size, rows.count(b), block);
      }
      rows.add(block, b, model_.free_indices(), sums);
    }
    NormalEquations equations = normal_equations(sums, model_.free_size);
    if (options_.robust) {
      equations.cost = losses.cost;
      equations.chi2 = losses.chi2;
    }
    return equations;
  }

  void add_prior(const SurfaceState& state, NormalEquations& equations) const {
    for (int axis = 0; axis < 2; ++axis) {
      const Vector3d tangent = prior_->tangents.col(axis) / prior_->sigma;
      const double F = tangent.dot(state.c - prior_->centre);
      ChartVector row = ChartVector::Zero();
      row.tail<3>() = state.R.transpose() * tangent;
      const StepVector F_p = reduced(model_, row);
      equations.A.noalias() += F_p * F_p.transpose();
      equations.b.noalias() += F * F_p;
      equations.cost += F * F;
    }
  }

  const Samples& samples_;
  const SurfaceModel& model_;
  const SurfaceFitOptions& options_;
  const std::optional<VertexPrior>& prior_;
  bool all_count_;  // nothing has to be weighed
};

double chi_square(const Samples& samples, const SurfaceModel& model, const SurfaceState& state,
                  Distance distance) {
  const SampleRows rows(samples, model, state, distance);
  return sum_of_residuals<double>(rows, [&](std::size_t i, const Residual& r, double& chi2) {
    if (counts(samples, i)) chi2 += r.F * r.F;
  });
}

// The first two, and of the others those that are better than both as they stand.
Starts worth_trying(const Samples& samples, const SurfaceModel& model, const Starts& starts,
                    Distance distance) {
  Starts tried;
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceState& start : starts) {
    const double chi2 = starts.size() > 2 ? chi_square(samples, model, start, distance) : 0.0;
    if (tried.size() >= 2 && !(chi2 < least)) continue;
    tried.push_back(start);
    least = std::min(least, chi2);
  }
  return tried;
}

// Weighted sums over foot points: 1, x, y, and x^2 + y^2.
struct Footprint {
  double weight = 0.0, x = 0.0, y = 0.0, squares = 0.0;

  void operator+=(const Footprint& other) {
    weight += other.weight;
    x += other.x;
    y += other.y;
    squares += other.squares;
  }
};

Footprint footprint_of_part(const SampleRows& rows, const Footprints& footprints, const Chunk& part) {
  RowBlock block;
  alignas(64) double weighted[3][block_size], ones[block_size];
  std::fill(std::begin(ones), std::end(ones), 1.0);
  const double *w[] = {weighted[0], weighted[1], weighted[2]}, *by[] = {ones, block.x[0], block.x[1]};
  MomentTile tile;
  for (std::size_t b = part.first; b < part.last; ++b) {
    rows.evaluate(b, block);
    settle_padding(rows.count(b), block);
    footprints.weigh(b, block, weighted[0]);
    for (std::size_t i = 0; i < block_size; ++i) {
      weighted[1][i] = weighted[0][i] * block.x[0][i];
      weighted[2][i] = weighted[0][i] * block.x[1][i];
    }
    fastest_moment_rows().add(w, 3, by, 3, rows.lanes_of(b), &tile);
  }
  return {sum_of(tile, 0), sum_of(tile, 1), sum_of(tile, 2), sum_of(tile, 4) + sum_of(tile, 8)};
}

}  // namespace

ChartMatrix chart_covariance(const SurfaceFit& fit) {
  const StepMatrix identity = StepMatrix::Identity(fit.A.rows(), fit.A.cols());
  return spread(fit.model, solve_positive(fit.A, identity));
}

double tukey_weight(double F) {
  const double inside = 1.0 - std::min(F * F / (tukey_constant * tukey_constant), 1.0);
  return inside * inside;
}

SurfaceFit fit_surface(const Samples& samples, const SurfaceModel& model, const SurfaceState& start,
                       const SurfaceFitOptions& options, const std::optional<VertexPrior>& prior) {
  SurfaceFit fit;
  fit.model = model;
  fit.state = start;
  if (model.vertex_prior) fit.prior = prior;
  const SurfaceProblem problem(samples, model, options, fit.prior);
  LeastSquaresOptions solver = options.solver;
  if (samples.progress) solver.keep_going = [&samples] { return samples.progress(during_fits); };
  LeastSquaresSummary summary = minimise(problem, fit.state, solver);
  fit.A = std::move(summary.at_solution.A);
  fit.cost = summary.at_solution.cost;
  fit.iterations = summary.iterations;
  fit.evaluations = summary.evaluations;
  fit.converged = summary.converged;
  fit.chi2 = summary.at_solution.chi2;
  return fit;
}

SurfaceFit fit_surface(const Samples& samples, const SurfaceModel& model, const Starts& starts,
                       const SurfaceFitOptions& options, const std::optional<VertexPrior>& prior) {
  if (starts.size() == 1) return fit_surface(samples, model, *starts.begin(), options, prior);
  SurfaceFitOptions brief = options;
  brief.solver.max_iterations = std::min(options.solver.max_iterations, trial_iterations);
  SurfaceFit best;
  best.cost = std::numeric_limits<double>::infinity();
  int iterations = 0;
  for (const SurfaceState& start : worth_trying(samples, model, starts, options.distance)) {
    SurfaceFit fit = fit_surface(samples, model, start, brief, prior);
    iterations += fit.iterations;
    if (fit.cost < best.cost) best = std::move(fit);
  }
  if (!best.converged) {
    best = fit_surface(samples, model, best.state, options, prior);
    iterations += best.iterations;
  }
  best.iterations = iterations;
  return best;
}

VertexStart vertex_start(const Samples& samples, const SurfaceFit& fixed) {
  const SampleRows rows(samples, fixed.model, fixed.state, Distance::exact);
  const Footprints footprints(samples, rows, fixed.state);
  const Footprint all = sum_over_parts<Footprint>(
      rows.blocks(), [&](const Chunk& part) { return footprint_of_part(rows, footprints, part); });
  const Vector2d centroid = Vector2d(all.x, all.y) / all.weight;
  const double size = 2.0 * std::sqrt(0.5 * std::max(all.squares / all.weight - centroid.squaredNorm(), 0.0));
  const Vector3d kappa = k3(fixed.model, fixed.state.k);
  const Vector3d centre = surface_point(centroid, kappa);
  VertexStart start;
  start.state = fixed.state;
  start.state.c = fixed.state.c + fixed.state.R * centre;
  start.state.R = turned_to(fixed.state.R, fixed.state.R * outward_normal(centre, kappa));
  const double share = 0.25 / static_cast<double>(samples.size()) + 0.05 * 0.05;  // method M4
  start.prior = {start.state.c, start.state.R.leftCols<2>(), size * std::sqrt(share), size};
  return start;
}

bool reevaluate_noise(Samples& samples, const SurfaceFit& fit) {
  const auto& covariance_at = samples.observations->covariance_at;
  if (!covariance_at) return false;
  const SampleRows rows(samples, fit.model, fit.state, Distance::exact);
  for_each_residual(rows, [&](std::size_t i, const Residual& r) {
    samples.set_cov(i, covariance_at(i, samples.origin + fit.state.c + fit.state.R * r.x));
  });
  return true;
}

}  // namespace patchlab
