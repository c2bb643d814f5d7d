#include "engine/fit/plane_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlab {
namespace {

std::vector<Vector2d> in_plane(const FootPoints& feet) {
  std::vector<Vector2d> points;
  points.reserve(feet.x.size());
  for (const Vector3d& x : feet.x) points.push_back(x.head<2>());
  return points;
}

double counted(const FootPoints& feet) {
  return static_cast<double>(
      std::count_if(feet.weight.begin(), feet.weight.end(), [](double w) { return w > 0.0; }));
}

// Mean variance of a foot point in the plane: what is left of its noise across the projection.
double lateral_variance(const Samples& samples, const SurfaceFit& fit) {
  const Vector3d z = fit.state.R.col(2);
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Matrix3d cov = samples.cov(i);
    const Vector3d along = cov * z;
    sum += 0.5 * (cov.trace() - along.squaredNorm() / z.dot(along));
  }
  return sum / static_cast<double>(samples.size());
}

std::optional<SoftShape> soft_edges(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet,
                                    Corners corners) {
  return fit_soft_edges(in_plane(feet), feet.weight, counted(feet), lateral_variance(samples, fit), corners);
}

// d (d_1..d_4 gamma w t) / d (d_1..d_4 gamma turn centre_x centre_y | chart): the frame turned about z and
// moved along the plane; the tilt and the height come from the plane's chart.
Eigen::Matrix<double, 11, 8 + chart_size> J_quad_local(const EdgeQuad& quad) {
  Eigen::Matrix<double, 11, 8 + chart_size> J = decltype(J)::Zero();
  const double c = std::cos(quad.turn), s = std::sin(quad.turn);
  const Matrix2d turned = (Matrix2d() << c, s, -s, c).finished();  // new axes from old
  J.topLeftCorner<5, 5>().setIdentity();
  J(7, 5) = 1.0;                     // w_z
  J.block<2, 2>(8, 6) = turned;      // t_x t_y
  J.block<2, 2>(5, 8 + 2) = turned;  // w_x w_y
  J(10, 8 + 2) = quad.centre.y();    // t_z + (w x centre)_z
  J(10, 8 + 3) = -quad.centre.x();
  J(10, 8 + 7) = 1.0;
  return J;
}

}  // namespace

std::optional<Patch> quad_patch(const Samples& samples, const SurfaceFit& fit, const FootPoints& feet,
                                double containment) {
  const std::optional<SoftShape> shape = soft_edges(samples, fit, feet, Corners::free);
  if (!shape) return std::nullopt;
  const EdgeQuad quad = quad_of_edges(moved_out(shape->edges, shape->inset));
  const EdgeMatrix J_quad_edges = quad_of_edges(shape->edges).J_quad_edges;
  Eigen::Matrix<double, 8 + chart_size, 8 + chart_size> cov = decltype(cov)::Zero();
  cov.topLeftCorner<8, 8>() = J_quad_edges * shape->covariance * J_quad_edges.transpose();
  cov.bottomRightCorner<chart_size, chart_size>() = chart_covariance(fit);
  auto J = J_quad_local(quad);
  J.topRows<4>() *= std::sqrt(containment);
  const PatchMatrix cov_local = J * cov * J.transpose();

  Boundary bound{BoundaryType::convex_quad, quad.d};
  bound.d.head(4) *= std::sqrt(containment);
  const Matrix3d R = fit.state.R * exp_map(Vector3d(0.0, 0.0, quad.turn));
  const Vector3d c = samples.origin + fit.state.c + fit.state.R.leftCols<2>() * quad.centre;
  return make_patch(*find_patch_type(SurfaceType::plane, BoundaryType::convex_quad), bound, {}, R, c,
                    PatchMatrix(0.5 * (cov_local + cov_local.transpose())));
}

Patch quad_of_rectangle(const Patch& rectangle) {
  const double l_plus = rectangle.parameters[0], l_minus = rectangle.parameters[1],
               d = std::hypot(l_plus, l_minus);
  Boundary bound{BoundaryType::convex_quad, BoundaryVector(5)};
  bound.d << d, d, d, d, std::atan2(l_minus, l_plus);  // Eq. (31)
  Eigen::Matrix<double, 11, 8> J = Eigen::Matrix<double, 11, 8>::Zero();
  J.topLeftCorner<4, 2>().rowwise() = Eigen::RowVector2d(l_plus / d, l_minus / d);
  J.block<1, 2>(4, 0) << -l_minus / (d * d), l_plus / (d * d);
  J.bottomRightCorner<6, 6>().setIdentity();
  const PatchMatrix cov_local = J * *rectangle.covariance_local * J.transpose();
  return make_patch(*find_patch_type(SurfaceType::plane, BoundaryType::convex_quad), bound, {},
                    axes(rectangle), centre(rectangle), cov_local);
}

std::optional<PlaneDirection> soft_direction(const Samples& samples, const SurfaceFit& fit,
                                             const FootPoints& feet, const MomentVector& m) {
  constexpr double alike = 1.2;  // method M7
  const double alpha = m[3] - m[0] * m[0], beta = 2.0 * (m[4] - m[0] * m[1]), phi = m[6] - m[1] * m[1];
  const double difference = std::hypot(beta, alpha - phi);
  if (alpha + phi + difference > alike * alike * (alpha + phi - difference)) return std::nullopt;
  const std::optional<SoftShape> shape = soft_edges(samples, fit, feet, Corners::right);
  if (!shape) return std::nullopt;
  const EdgeVector& e = shape->edges;
  const bool long_across =
      e[1] + e[5] >= e[3] + e[7];  // width along the normal of edge 1 against that of edge 2
  return PlaneDirection{e[0] + (long_across ? 0.0 : std::numbers::pi / 2.0), shape->covariance(0, 0)};
}

}  // namespace patchlab
