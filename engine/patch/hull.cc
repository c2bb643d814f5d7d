#include "engine/patch/hull.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace patchlab {
namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The ellipse (u - centre)' S^-1 (u - centre) = 1, grown until it holds the hull.
TurnedShape grown(const std::vector<Vector2d>& hull, const Vector2d& centre, const Matrix2d& S) {
  const Matrix2d inverse = S.inverse();
  double growth = 0.0;
  for (const Vector2d& p : hull) growth = std::max(growth, (p - centre).dot(inverse * (p - centre)));
  const double middle = 0.5 * S.trace(), half = 0.5 * (S(0, 0) - S(1, 1)), apart = std::hypot(half, S(0, 1));
  const Vector2d variances(middle + apart, std::max(middle - apart, 0.0));
  return {centre, 0.5 * std::atan2(S(0, 1), half), (growth * variances).cwiseSqrt()};
}

}  // namespace

std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  std::ranges::sort(points, [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {  // the lower chain, then the upper
    const std::size_t first = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

TurnedShape smallest_ellipse(const std::vector<Vector2d>& hull, double tolerance) {
  constexpr int most_steps = 2000;
  std::vector<double> weights(hull.size(), 1.0 / static_cast<double>(hull.size()));
  Matrix3d X = Matrix3d::Zero();
  for (int step = 0; step < most_steps; ++step) {
    X.setZero();
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vector3d lifted(hull[i].x(), hull[i].y(), 1.0);
      X += weights[i] * lifted * lifted.transpose();
    }
    const Matrix3d inverse = X.inverse();
    std::size_t farthest = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vector3d lifted(hull[i].x(), hull[i].y(), 1.0);
      const double reach = lifted.dot(inverse * lifted);
      if (reach > most) {
        most = reach;
        farthest = i;
      }
    }
    if (!(most > 3.0 * (1.0 + tolerance))) break;
    const double move = (most - 3.0) / (3.0 * (most - 1.0));
    for (double& weight : weights) weight *= 1.0 - move;
    weights[farthest] += move;
  }
  const Vector2d centre = X.topRightCorner<2, 1>();
  return grown(hull, centre, 2.0 * (X.topLeftCorner<2, 2>() - centre * centre.transpose()));
}

}  // namespace patchlab
