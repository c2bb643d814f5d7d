#include "engine/fit/soft_edge.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>

#include "engine/base/chi_square.h"
#include "engine/fit/edge_lines.h"
#include "engine/fit/shapes_about.h"
#include "engine/patch/hull.h"

namespace patchlab {
namespace {

using AreaDual = Eigen::AutoDiffScalar<EdgeVector>;

// The map from the free numbers of a shape to its edges: all eight, or phi rho_1..rho_4 of a rectangle.
Eigen::Matrix<double, 8, Eigen::Dynamic, 0, 8, 8> J_edges_free(Corners corners) {
  if (corners == Corners::free) return EdgeMatrix::Identity();
  Eigen::Matrix<double, 8, Eigen::Dynamic, 0, 8, 8> J(8, 5);
  J.setZero();
  for (int e = 0; e < 4; ++e) {
    J(2 * e, 0) = 1.0;
    J(2 * e + 1, 1 + e) = 1.0;
  }
  return J;
}

struct Likelihood {
  double value;
  EdgeVector gradient;
  EdgeMatrix information;  // minus the second derivative
};

// Inverse Mills ratio phi(t)/Phi(t).
double mills(double t) {
  return std::exp(-0.5 * t * t - 0.5 * std::log(2.0 * std::numbers::pi) - log_normal_cdf(t));
}

class SoftEdgeProblem {
 public:
  SoftEdgeProblem(const std::vector<Vector2d>& points, const std::vector<double>& weights, double used,
                  double sigma)
      : points_(points), weights_(weights), used_(used), sigma_(sigma) {}

  // Whether the sides turn left at each corner and are longer than their softness: beyond, a side is of no
  // account, and the area says nothing.
  bool is_quad(const EdgeVector& edges) const {
    const Area<double> area = area_of<double>(edges);
    for (int e = 0; e < 4; ++e)
      if (!(std::sin(edges[2 * ((e + 1) % 4)] - edges[2 * e]) > 0.0 && area.gradient[2 * e + 1] > sigma_))
        return false;
    return true;
  }

  Likelihood evaluate(const EdgeVector& edges) const {
    Likelihood all = area_term(edges);
    for (int e = 0; e < 4; ++e) add_edge(edges, e, all);
    return all;
  }

 private:
  Likelihood area_term(const EdgeVector& edges) const {
    Edges<AreaDual> dual;
    for (int i = 0; i < 8; ++i) dual[i] = AreaDual(edges[i], 8, i);
    const Area<AreaDual> area = area_of<AreaDual>(dual);
    const double a = area.value.value();
    Likelihood term;
    term.value = a > 0.0 ? -used_ * std::log(a) : -std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) {
      term.gradient[i] = -used_ * area.gradient[i].value() / a;
      term.information.row(i) = used_ * area.gradient[i].derivatives().transpose() / a;
    }
    term.information -= term.gradient * term.gradient.transpose() / used_;
    return term;
  }

  void add_edge(const EdgeVector& edges, int e, Likelihood& all) const {
    const Vector2d n(std::cos(edges[2 * e]), std::sin(edges[2 * e])), tangent(-n.y(), n.x());
    Vector2d gradient = Vector2d::Zero();
    Matrix2d information = Matrix2d::Zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (weights_[i] == 0.0) continue;
      const double t = (edges[2 * e + 1] - n.dot(points_[i])) / sigma_, weight = used_ * weights_[i];
      all.value += weight * log_normal_cdf(t);
      if (t > 9.0) continue;
      const double h = mills(t);
      const Vector2d t_p(-tangent.dot(points_[i]) / sigma_, 1.0 / sigma_);
      gradient += weight * h * t_p;
      information += weight * h * (t + h) * t_p * t_p.transpose();
      information(0, 0) -= weight * h * n.dot(points_[i]) / sigma_;
    }
    all.gradient.segment<2>(2 * e) += gradient;
    all.information.block<2, 2>(2 * e, 2 * e) += information;
  }

  const std::vector<Vector2d>& points_;
  const std::vector<double>& weights_;
  double used_, sigma_;
};

// Damped Newton in the free numbers of the shape, from one quad to the next. False where it ends at none with
// a covariance.
bool climb(const SoftEdgeProblem& problem, Corners corners, SoftShape& shape) {
  const auto J = J_edges_free(corners);
  using Free = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;
  Likelihood here = problem.evaluate(shape.edges);
  double damping = 1e-3;
  for (int iteration = 0; iteration < 200 && damping < 1e12; ++iteration) {
    const Free information = J.transpose() * here.information * J;
    const Free scale =
        information.diagonal().cwiseAbs().cwiseMax(1e-9 * information.cwiseAbs().maxCoeff()).asDiagonal();
    const Eigen::LLT<Free> solver(information + damping * scale);
    if (solver.info() != Eigen::Success) {
      damping *= 4.0;
      continue;
    }
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1> free = J.transpose() * here.gradient;
    const EdgeVector step = J * solver.solve(free);
    const EdgeVector moved = shape.edges + step;
    std::optional<Likelihood> there;
    if (problem.is_quad(moved)) there = problem.evaluate(moved);
    if (!there || !(there->value >= here.value)) {
      damping *= 4.0;
      continue;
    }
    const double gain = step.dot(here.gradient);
    shape.edges = moved;
    here = *there;
    damping = std::max(damping / 5.0, 1e-12);
    if (gain < 1e-12) break;
  }
  shape.log_likelihood = here.value;
  const Free information = J.transpose() * here.information * J;
  if (!problem.is_quad(shape.edges) || information.llt().info() != Eigen::Success) return false;
  shape.covariance = J * information.ldlt().solve(Free::Identity(J.cols(), J.cols())) * J.transpose();
  return true;
}

// Points that end sharply, seen through a likelihood that expects them to end softly (sigma), put the edge
// inside the true one: where Phi(t) = 1/e, t = -0.3375. With noise sigma_0 < sigma of their own they put it
// in by 0.3375 (sigma^2 - sigma_0^2) / sigma, to 2 % of that.
constexpr double inset_of_sharp_edges = 0.3375;

}  // namespace

std::optional<SoftShape> fit_soft_edges(const std::vector<Vector2d>& points,
                                        const std::vector<double>& weights, double used,
                                        double lateral_variance, Corners corners) {
  std::vector<Vector2d> counted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights[i] > 0.0) counted.push_back(points[i]);
  }
  const std::vector<Vector2d> hull = convex_hull(counted);
  if (hull.size() < 3) return std::nullopt;
  std::vector<EdgeVector> begin = {rectangle_about(hull)};
  if (corners == Corners::free && hull.size() >= 4) begin.push_back(quad_about(hull));
  std::optional<SoftShape> best;
  for (const EdgeVector& edges : begin) {
    SoftShape shape{.edges = edges};
    double softened = 0.0, sigma = 0.0;
    bool is_sound = true;
    for (int pass = 0; pass < 2 && is_sound; ++pass) {
      softened = area_of<double>(shape.edges).value / (16.0 * used);
      sigma = std::sqrt(lateral_variance + softened);
      is_sound = climb(SoftEdgeProblem(points, weights, used, sigma), corners, shape);
    }
    shape.inset = inset_of_sharp_edges * softened / sigma;
    if (is_sound && (!best || shape.log_likelihood > best->log_likelihood)) best = shape;
  }
  return best;
}

}  // namespace patchlab
