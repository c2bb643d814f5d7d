#include "engine/map/hull.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlab {
namespace {

constexpr double beyond_all = std::numeric_limits<double>::infinity();

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Half extents and middle of the points along axes turned by `angle`.
TurnedShape box_at(const std::vector<Vector2d>& points, double angle) {
  const Vector2d x(std::cos(angle), std::sin(angle)), y(-x.y(), x.x());
  Vector2d low(beyond_all, beyond_all), high(-beyond_all, -beyond_all);
  for (const Vector2d& p : points) {
    const Vector2d q(x.dot(p), y.dot(p));
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  const Vector2d middle = 0.5 * (low + high);
  return {middle.x() * x + middle.y() * y, angle, 0.5 * (high - low)};
}

double area_of(const std::array<Vector2d, 4>& v) { return 0.5 * cross(v[2] - v[0], v[3] - v[1]); }

// Where the lines along two sides of the hull meet, going counterclockwise from one to the other.
std::optional<Vector2d> meeting(const std::vector<Vector2d>& hull, std::size_t i, std::size_t j) {
  const Vector2d a = hull[i], b = hull[j];
  const Vector2d u = hull[(i + 1) % hull.size()] - a, v = hull[(j + 1) % hull.size()] - b;
  const double turn = cross(u, v);
  if (turn <= 1e-9 * u.norm() * v.norm()) return std::nullopt;  // half a turn or more: they never close
  return a + u * (cross(b - a, v) / turn);
}

}  // namespace

std::vector<Vector2d> hull_around(std::vector<Vector2d> points) {
  std::ranges::sort(points, [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {  // the lower chain, then the upper
    const std::size_t start = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

Eigen::Vector3d ball_centre(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d centre = points.front();
  for (int i = 1; i <= 2000; ++i) {
    const auto farthest = std::ranges::max_element(
        points, {}, [&](const Eigen::Vector3d& p) { return (p - centre).squaredNorm(); });
    centre += (*farthest - centre) / (i + 1.0);
  }
  return centre;
}

TurnedShape smallest_rectangle(const std::vector<Vector2d>& hull) {
  TurnedShape best = box_at(hull, 0.0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d side = hull[(i + 1) % hull.size()] - hull[i];
    const TurnedShape box = box_at(hull, std::atan2(side.y(), side.x()));
    if (box.d.prod() < best.d.prod()) best = box;
  }
  return best;
}

// Khachiyan's algorithm for the smallest ellipse around points, grown to hold them all.
TurnedShape smallest_ellipse(const std::vector<Vector2d>& hull) {
  const auto n = static_cast<Eigen::Index>(hull.size());
  Eigen::Matrix3Xd Q(3, n);
  for (Eigen::Index i = 0; i < n; ++i) Q.col(i) << hull[static_cast<std::size_t>(i)], 1.0;
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  for (int step = 0; step < 2000; ++step) {
    const Eigen::Matrix3d X = Q * weight.asDiagonal() * Q.transpose();
    const Eigen::VectorXd M = (Q.transpose() * X.inverse() * Q).diagonal();
    Eigen::Index farthest = 0;
    const double most = M.maxCoeff(&farthest);
    if (most < 3.0 * (1.0 + 1e-6)) break;
    const double move = (most - 3.0) / (3.0 * (most - 1.0));
    weight *= 1.0 - move;
    weight[farthest] += move;
  }
  const Vector2d centre = Q.topRows<2>() * weight;
  const Eigen::Matrix2Xd P = Q.topRows<2>();
  const Eigen::Matrix2d S = 2.0 * (P * weight.asDiagonal() * P.transpose() - centre * centre.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(S);
  const Eigen::Matrix2d inverse = S.inverse();
  double grown = 0.0;
  for (const Vector2d& p : hull) grown = std::max(grown, (p - centre).dot(inverse * (p - centre)));
  const Vector2d x = solver.eigenvectors().col(1);
  return {centre, std::atan2(x.y(), x.x()), (grown * solver.eigenvalues().reverse()).cwiseSqrt()};
}

Vector2d smallest_centred_ellipse(const std::vector<Vector2d>& points) {
  // d_x = s a, d_y = a / s: the least area a^2 by the ratio s^2, convex in log s.
  const auto size = [&](double log_s) {
    double largest = 0.0;
    for (const Vector2d& p : points) {
      largest = std::max(largest, std::hypot(p.x() * std::exp(-log_s), p.y() * std::exp(log_s)));
    }
    return largest;
  };
  double low = -4.0, high = 4.0;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (size(a) < size(b) ? high : low) = size(a) < size(b) ? b : a;
  }
  const double log_s = 0.5 * (low + high), a = size(log_s);
  return {a * std::exp(log_s), a * std::exp(-log_s)};
}

std::optional<std::array<Vector2d, 4>> smallest_quad(const std::vector<Vector2d>& hull) {
  std::optional<std::array<Vector2d, 4>> best;
  const std::size_t n = hull.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        for (std::size_t l = k + 1; l < n; ++l) {
          const auto a = meeting(hull, i, j), b = meeting(hull, j, k), c = meeting(hull, k, l),
                     d = meeting(hull, l, i);
          if (!a || !b || !c || !d) continue;
          const std::array<Vector2d, 4> quad = {*a, *b, *c, *d};
          if (!best || area_of(quad) < area_of(*best)) best = quad;
        }
      }
    }
  }
  return best;
}

}  // namespace patchlab
