#include "engine/fit/fit_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

// The problem that engine/fit/least_squares.h solves, Eq. (33), with the prior as two more residuals.
class SurfaceProblem {
 public:
  using State = SurfaceState;

  SurfaceProblem(const Samples& samples, const SurfaceModel& model, const SurfaceFitOptions& options,
                 const std::optional<VertexPrior>& prior)
      : samples_(samples), model_(model), options_(options), prior_(prior) {}

  NormalEquations evaluate(const SurfaceState& state) const {
    ChartMatrix A = ChartMatrix::Zero();
    ChartVector b = ChartVector::Zero();
    double cost = 0.0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (samples_.robust[i] == 0.0 || samples_.bends[i] == 0) continue;
      const Residual r = residual(options_.distance, model_, state, samples_.q[i], samples_.cov[i]);
      const double scale = options_.robust_scale;
      const double weight = options_.robust ? tukey_weight(r.F / scale) : 1.0;
      cost += options_.robust ? scale * scale * tukey_loss(r.F / scale) : r.F * r.F;
      A.noalias() += weight * r.F_p * r.F_p.transpose();
      b.noalias() += weight * r.F * r.F_p;
    }
    if (prior_) add_prior(state, A, b, cost);
    return reduced(A, b, cost);
  }

  SurfaceState retract(const SurfaceState& state, const StepVector& step) const {
    return patchlab::retract(state, spread(model_, step));
  }

 private:
  void add_prior(const SurfaceState& state, ChartMatrix& A, ChartVector& b, double& cost) const {
    for (int axis = 0; axis < 2; ++axis) {
      const Vector3d tangent = prior_->tangents.col(axis) / prior_->sigma;
      const double F = tangent.dot(state.c - prior_->centre);
      ChartVector F_p = ChartVector::Zero();
      F_p.tail<3>() = state.R.transpose() * tangent;
      A.noalias() += F_p * F_p.transpose();
      b.noalias() += F * F_p;
      cost += F * F;
    }
  }

  NormalEquations reduced(const ChartMatrix& A, const ChartVector& b, double cost) const {
    const int n = model_.free_size;
    NormalEquations equations{cost, StepMatrix(n, n), StepVector(n)};
    const auto free = model_.free_indices();
    for (int i = 0; i < n; ++i) {
      const int row = free[static_cast<std::size_t>(i)];
      equations.b[i] = b[row];
      for (int j = 0; j < n; ++j) equations.A(i, j) = A(row, free[static_cast<std::size_t>(j)]);
    }
    return equations;
  }

  const Samples& samples_;
  const SurfaceModel& model_;
  const SurfaceFitOptions& options_;
  const std::optional<VertexPrior>& prior_;
};

double chi_square(const Samples& samples, const SurfaceModel& model, const SurfaceState& state,
                  Distance distance) {
  double chi2 = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples.robust[i] == 0.0 || samples.bends[i] == 0) continue;
    const double F = residual(distance, model, state, samples.q[i], samples.cov[i]).F;
    chi2 += F * F;
  }
  return chi2;
}

// The first two, and of the others those that are better than both as they stand.
std::vector<SurfaceState> worth_trying(const Samples& samples, const SurfaceModel& model,
                                       const std::vector<SurfaceState>& starts, Distance distance) {
  std::vector<SurfaceState> tried;
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceState& start : starts) {
    const double chi2 = starts.size() > 2 ? chi_square(samples, model, start, distance) : 0.0;
    if (tried.size() >= 2 && !(chi2 < least)) continue;
    tried.push_back(start);
    least = std::min(least, chi2);
  }
  return tried;
}

}  // namespace

ChartMatrix chart_covariance(const SurfaceFit& fit) {
  return spread(fit.model, StepMatrix(fit.A.ldlt().solve(StepMatrix::Identity(fit.A.rows(), fit.A.cols()))));
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
  fit.converged = summary.converged;
  fit.chi2 = chi_square(samples, model, fit.state, options.distance);
  return fit;
}

SurfaceFit fit_surface(const Samples& samples, const SurfaceModel& model,
                       const std::vector<SurfaceState>& starts, const SurfaceFitOptions& options,
                       const std::optional<VertexPrior>& prior) {
  if (starts.size() == 1) return fit_surface(samples, model, starts.front(), options, prior);
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

FootPoints foot_points(const Samples& samples, const SurfaceFit& fit) {
  constexpr double least_cosine = 0.15;
  const std::optional<Vector3d>& axis = samples.observations->optical_axis;
  FootPoints feet;
  feet.x.reserve(samples.size());
  feet.weight.reserve(samples.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Residual r = residual(Distance::exact, fit.model, fit.state, samples.q[i], samples.cov[i]);
    double weight = samples.robust[i] > 0.0 ? 1.0 : 0.0;
    if (axis) {
      const Vector3d n = r.g.normalized();
      const Vector3d from_camera = fit.state.c + fit.state.R * r.x - samples.viewpoint(i);
      const Vector3d ray = from_camera.normalized();
      const double depth = axis->dot(from_camera), cos_psi = std::abs(axis->dot(ray));
      const double facing = std::max(std::abs(n.dot(fit.state.R.transpose() * ray)), least_cosine);
      weight *= depth * depth * cos_psi * std::abs(n.z()) / facing;  // method M3
    }
    feet.x.push_back(r.x);
    feet.weight.push_back(std::max(weight, 0.0));
    sum += feet.weight.back();
  }
  for (double& weight : feet.weight) weight /= sum;
  return feet;
}

FootPoints plain_projection(const Samples& samples, const SurfaceFit& fit) {
  FootPoints points;
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    points.x.push_back(to_local(fit.state, samples.q[i]));
    points.weight.push_back(samples.robust[i] > 0.0 ? 1.0 : 0.0);
    sum += points.weight.back();
  }
  for (double& weight : points.weight) weight /= sum;
  return points;
}

VertexStart vertex_start(const Samples& samples, const SurfaceFit& fixed) {
  const FootPoints feet = foot_points(samples, fixed);
  Vector2d centroid = Vector2d::Zero();
  for (std::size_t i = 0; i < feet.x.size(); ++i) centroid += feet.weight[i] * feet.x[i].head<2>();
  double spread = 0.0;
  for (std::size_t i = 0; i < feet.x.size(); ++i) {
    spread += feet.weight[i] * (feet.x[i].head<2>() - centroid).squaredNorm();
  }
  const double size = 2.0 * std::sqrt(0.5 * spread);
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
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Residual r = residual(Distance::exact, fit.model, fit.state, samples.q[i], samples.cov[i]);
    samples.cov[i] = covariance_at(i, samples.origin + fit.state.c + fit.state.R * r.x);
  }
  return true;
}

}  // namespace patchlab
