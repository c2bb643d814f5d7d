#include "engine/fit/soft_edge.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>

#include "engine/base/chi_square.h"

namespace patchlab {
namespace {

using Dual = Eigen::AutoDiffScalar<EdgeVector>;
template <class T>
using Vector2 = Eigen::Matrix<T, 2, 1>;
template <class T>
using Edges = Eigen::Matrix<T, 8, 1>;

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

// Tangential coordinate, along edge a, of its meeting with edge b.
template <class T>
T meeting(const Edges<T>& edges, int a, int b) {
  using std::cos;
  using std::sin;
  const T turn = edges[2 * b] - edges[2 * a];
  return (edges[2 * b + 1] - edges[2 * a + 1] * cos(turn)) / sin(turn);
}

template <class T>
Vector2<T> corner(const Edges<T>& edges, int a, int b) {
  using std::cos;
  using std::sin;
  const T s = meeting<T>(edges, a, b), c = cos(edges[2 * a]), n = sin(edges[2 * a]), rho = edges[2 * a + 1];
  return {T(rho * c - s * n), T(rho * n + s * c)};
}

// Area and its gradient: an edge of length L moved out by d rho sweeps L d rho; turned by d phi it sweeps
// -(s_2^2 - s_1^2)/2 d phi.
template <class T>
struct Area {
  T value = T(0.0);
  Edges<T> gradient;
};
template <class T>
Area<T> area_of(const Edges<T>& edges) {
  Area<T> area;
  for (int e = 0; e < 4; ++e) {
    const T s_1 = meeting<T>(edges, e, (e + 3) % 4), s_2 = meeting<T>(edges, e, (e + 1) % 4);
    area.gradient[2 * e] = T(0.5) * (s_1 * s_1 - s_2 * s_2);
    area.gradient[2 * e + 1] = s_2 - s_1;
    area.value += T(0.5) * edges[2 * e + 1] * (s_2 - s_1);
  }
  return area;
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

  Likelihood evaluate(const EdgeVector& edges) const {
    Likelihood all = area_term(edges);
    for (int e = 0; e < 4; ++e) add_edge(edges, e, all);
    return all;
  }

 private:
  Likelihood area_term(const EdgeVector& edges) const {
    Edges<Dual> dual;
    for (int i = 0; i < 8; ++i) dual[i] = Dual(edges[i], 8, i);
    const Area<Dual> area = area_of<Dual>(dual);
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

// Damped Newton in the free numbers of the shape.
void climb(const SoftEdgeProblem& problem, Corners corners, SoftShape& shape) {
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
    Likelihood there = problem.evaluate(shape.edges + step);
    if (!(there.value >= here.value)) {
      damping *= 4.0;
      continue;
    }
    const double gain = step.dot(here.gradient);
    shape.edges += step;
    here = std::move(there);
    damping = std::max(damping / 5.0, 1e-12);
    if (gain < 1e-12) {
      shape.converged = true;
      break;
    }
  }
  shape.log_likelihood = here.value;
  const Free information = J.transpose() * here.information * J;
  shape.covariance =
      J * information.ldlt().solve(Free::Identity(information.rows(), information.cols())) * J.transpose();
}

// Points that end sharply, seen through a likelihood that expects them to end softly (sigma), put the edge
// inside the true one: where Phi(t) = 1/e, t = -0.3375. With noise sigma_0 < sigma of their own they put it
// in by 0.3375 (sigma^2 - sigma_0^2) / sigma, to 2 % of that.
constexpr double inset_of_sharp_edges = 0.3375;

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

// A convex polygon as lines, for dropping edges.
struct Line {
  double phi, rho;
};
Vector2d meet(const Line& a, const Line& b) {
  Edges<double> edges = Edges<double>::Zero();
  edges.head<4>() << a.phi, a.rho, b.phi, b.rho;
  return corner<double>(edges, 0, 1);
}

// Area gained when line i is dropped and its neighbours are extended to meet; infinite when they do not.
double cost_of_dropping(const std::vector<Line>& lines, std::size_t i) {
  const std::size_t n = lines.size();
  const Line &before = lines[(i + n - 1) % n], &after = lines[(i + 1) % n];
  const double turn = wrapped(after.phi - before.phi);
  if (turn <= 1e-6 || turn >= std::numbers::pi - 1e-3) return std::numeric_limits<double>::infinity();
  const Vector2d tip = meet(before, after), p = meet(before, lines[i]), q = meet(lines[i], after);
  return 0.5 * std::abs((p - tip).x() * (q - tip).y() - (p - tip).y() * (q - tip).x());
}

EdgeVector quad_about(const std::vector<Vector2d>& hull) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d along = hull[(i + 1) % hull.size()] - hull[i];
    const double phi = std::atan2(-along.x(), along.y());
    lines.push_back({phi, Vector2d(std::cos(phi), std::sin(phi)).dot(hull[i])});
  }
  while (lines.size() > 4) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double cost = cost_of_dropping(lines, i);
      if (cost < least) {
        least = cost;
        best = i;
      }
    }
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(best));
  }
  EdgeVector edges;
  for (int e = 0; e < 4; ++e) {
    const Line& l = lines[static_cast<std::size_t>(e)];
    edges.segment<2>(2 * e) << l.phi, l.rho;
  }
  return edges;
}

// The rectangle of least area about a hull: one side lies on a hull edge.
EdgeVector rectangle_about(const std::vector<Vector2d>& hull) {
  EdgeVector best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d along = hull[(i + 1) % hull.size()] - hull[i];
    const double phi = std::atan2(-along.x(), along.y());
    EdgeVector edges;
    for (int e = 0; e < 4; ++e) {
      const double angle = phi + e * std::numbers::pi / 2.0;
      const Vector2d n(std::cos(angle), std::sin(angle));
      double reach = -std::numeric_limits<double>::infinity();
      for (const Vector2d& v : hull) reach = std::max(reach, n.dot(v));
      edges.segment<2>(2 * e) << angle, reach;
    }
    const double area = (edges[1] + edges[5]) * (edges[3] + edges[7]);
    if (area < least) {
      least = area;
      best = edges;
    }
  }
  return best;
}

}  // namespace

std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  const auto turn = [](const Vector2d& o, const Vector2d& a, const Vector2d& b) {
    return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
  };
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

SoftShape fit_soft_edges(const std::vector<Vector2d>& points, const std::vector<double>& weights, double used,
                         double lateral_variance, Corners corners) {
  std::vector<Vector2d> counted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights[i] > 0.0) counted.push_back(points[i]);
  }
  const std::vector<Vector2d> hull = convex_hull(counted);
  std::vector<EdgeVector> begin = {rectangle_about(hull)};
  if (corners == Corners::free && hull.size() >= 4) begin.push_back(quad_about(hull));
  SoftShape best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  for (const EdgeVector& edges : begin) {
    SoftShape shape{.edges = edges};
    double softened = 0.0, sigma = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
      softened = area_of<double>(shape.edges).value / (16.0 * used);
      sigma = std::sqrt(lateral_variance + softened);
      climb(SoftEdgeProblem(points, weights, used, sigma), corners, shape);
    }
    shape.inset = inset_of_sharp_edges * softened / sigma;
    if (shape.log_likelihood > best.log_likelihood) best = shape;
  }
  return best;
}

EdgeVector moved_out(const EdgeVector& edges, double by) {
  EdgeVector moved = edges;
  for (int e = 0; e < 4; ++e) moved[2 * e + 1] += by;
  return moved;
}

EdgeQuad quad_of_edges(const EdgeVector& edges) {
  using std::acos;
  using std::atan2;
  using std::sqrt;
  Edges<Dual> dual;
  for (int i = 0; i < 8; ++i) dual[i] = Dual(edges[i], 8, i);
  std::array<Vector2<Dual>, 4> v;
  for (int i = 0; i < 4; ++i) v[static_cast<std::size_t>(i)] = corner<Dual>(dual, i, (i + 1) % 4);
  const Vector2<Dual> a = v[2] - v[0], b = v[3] - v[1], across = v[1] - v[0];
  const Dual denominator = a[0] * b[1] - a[1] * b[0];
  const Dual share =
      (across[0] * b[1] - across[1] * b[0]) / denominator;  // the diagonals meet at v_1 + share a
  const Vector2<Dual> centre = {Dual(v[0][0] + share * a[0]), Dual(v[0][1] + share * a[1])};
  EdgeQuad quad;
  const auto put = [&](int row, const Dual& value) {
    quad.J_quad_edges.row(row) = value.derivatives().transpose();
    return value.value();
  };
  std::array<Dual, 4> angle;
  for (int i = 0; i < 4; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Dual x = v[at][0] - centre[0], y = v[at][1] - centre[1];
    quad.d[i] = put(i, Dual(sqrt(Dual(x * x + y * y))));
    angle[at] = atan2(y, x);
  }
  const double offset = wrapped(angle[0].value() - angle[3].value()) - (angle[0].value() - angle[3].value());
  quad.d[4] = put(4, Dual(0.5 * (angle[0] - angle[3] + offset)));  // gamma, Eq. (21)
  quad.turn = put(5, Dual(angle[0] - 0.5 * (angle[0] - angle[3] + offset)));
  quad.centre = {put(6, centre[0]), put(7, centre[1])};
  return quad;
}

}  // namespace patchlab
