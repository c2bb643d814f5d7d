#include "engine/fit/fit_boundary.h"

#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "engine/base/chi_square.h"

namespace patchlab {
namespace {

using Gradient = Eigen::Matrix<double, joint_size, 1>;
using Dual = Eigen::AutoDiffScalar<Gradient>;
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
Vector3<T> scaled(const Vector3<T>& a, const T& s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
template <class T>
Vector3<T> normalised(const Vector3<T>& a) {
  using std::sqrt;
  return scaled<T>(a, T(1.0 / sqrt(dot<T>(a, a))));
}

// A frame and a centre in the axes of the surface fit, and the bound's parameters.
template <class T>
struct Placed {
  Vector3<T> x, y, z, c;
  Eigen::Matrix<T, 2, 1> d;
};

template <class T>
struct Moments {
  Vector3<T> mean;
  Matrix3<T> second;  // about the local origin

  // Second moment about a point along a direction pair.
  T about(const Vector3<T>& c, const Vector3<T>& a, const Vector3<T>& b) const {
    T sum = T(0.0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        sum += a[i] * b[j] * (second(i, j) - mean[i] * c[j] - c[i] * mean[j] + c[i] * c[j]);
      }
    }
    return sum;
  }
};

template <class T>
Moments<T> unpack(const Eigen::Matrix<T, moments_size, 1>& m) {
  Moments<T> moments;
  moments.mean = {m[0], m[1], m[2]};
  moments.second << m[3], m[4], m[5], m[4], m[6], m[7], m[5], m[7], m[8];
  return moments;
}

template <class T>
Placed<T> as_fitted() {
  const T one(1.0), zero(0.0);
  Placed<T> placed;
  placed.x = {one, zero, zero};
  placed.y = {zero, one, zero};
  placed.z = {zero, zero, one};
  placed.c = {zero, zero, zero};
  placed.d = {zero, zero};
  return placed;
}

// fitting.md section 3, step 6: the apex of a sphere or cylinder moves so that z_l passes through the
// centroid; w is from the centroid to the old apex, across the axis for the cylinder. No division by kappa.
template <class T>
void move_apex(Placed<T>& placed, const Vector3<T>& mean, const T& kappa, bool cylinder) {
  using std::sqrt;
  const T zero(0.0), one(1.0);
  const Vector3<T> w = {cylinder ? zero : T(-mean[0]), T(-mean[1]), T(-mean[2])};
  const Vector3<T> towards = {kappa * w[0], kappa * w[1], one + kappa * w[2]};  // z + kappa w
  const T n = sqrt(dot<T>(towards, towards));
  const T along = (T(2.0) * w[2] + kappa * dot<T>(w, w)) / (one + n);
  placed.c = {-w[0] / n, -w[1] / n, -(w[2] - along) / n};
  placed.z = scaled<T>(towards, T(one / n));
  const Vector3<T> x0 = {one, zero, zero};
  placed.x = normalised<T>(x0 - scaled<T>(placed.z, placed.z[0]));
  placed.y = cross<T>(placed.z, placed.x);
}

template <class T>
T root(const T& variance, double factor) {
  using std::sqrt;
  return variance > T(0.0) ? T(factor * sqrt(variance)) : T(0.0);
}

template <class T>
T circle(const T& v_x, const T& v_y, double factor, bool larger) {
  return root<T>(larger ? (v_x > v_y ? v_x : v_y) : T(0.5 * (v_x + v_y)), factor);
}

template <class T>
void turn_about_z(Placed<T>& placed, const T& theta) {
  using std::cos;
  using std::sin;
  const T c = cos(theta), s = sin(theta);
  const Vector3<T> x = placed.x, y = placed.y;
  placed.x = scaled<T>(x, c) + scaled<T>(y, s);
  placed.y = scaled<T>(y, c) - scaled<T>(x, s);
}

// Step 9: principal variances of a plane's points and the turn to their axes, Eqs. (30), (32).
template <class T>
void place_plane(Placed<T>& placed, const Moments<T>& m, const PatchTypeRow& type,
                 const BoundaryScale& scale) {
  using std::atan2;
  using std::sqrt;
  const T alpha = m.about(placed.c, placed.x, placed.x), phi = m.about(placed.c, placed.y, placed.y);
  const T beta = T(2.0) * m.about(placed.c, placed.x, placed.y);
  const T difference = sqrt(T(beta * beta + (alpha - phi) * (alpha - phi) + T(1e-300)));
  const T larger = T(0.5) * (alpha + phi + difference), smaller = T(0.5) * (alpha + phi - difference);
  if (type.boundary == BoundaryType::circle) {
    placed.d[0] = scale.larger_axis ? root<T>(larger, scale.plane_circle)
                                    : root<T>(T(0.5) * (alpha + phi), scale.plane_circle);
    return;
  }
  const double factor = type.boundary == BoundaryType::ellipse ? scale.plane_ellipse : scale.plane_rectangle;
  placed.d = {root<T>(larger, factor), root<T>(smaller, factor)};
  turn_about_z<T>(placed, T(T(0.5) * atan2(beta, T(alpha - phi))));  // Eq. (32)
}

template <class T>
void place_along(Placed<T>& placed, const Moments<T>& m, const BoundaryScale& scale, double angle) {
  turn_about_z<T>(placed, T(angle));
  placed.d = {root<T>(m.about(placed.c, placed.x, placed.x), scale.plane_rectangle),
              root<T>(m.about(placed.c, placed.y, placed.y), scale.plane_rectangle)};
}

template <class T>
Placed<T> place(const T& kappa, const Moments<T>& m, const PatchTypeRow& type, const BoundaryScale& scale,
                Apex apex, const std::optional<PlaneDirection>& direction) {
  Placed<T> placed = as_fitted<T>();
  const bool cylinder = type.surface == SurfaceType::circular_cylinder;
  if (type.surface == SurfaceType::plane) {
    placed.c = {m.mean[0], m.mean[1], T(0.0)};
    if (direction) {
      place_along<T>(placed, m, scale, direction->angle);
    } else {
      place_plane<T>(placed, m, type, scale);
    }
    return placed;
  }
  if (apex == Apex::over_centroid && (cylinder || type.surface == SurfaceType::sphere)) {
    move_apex<T>(placed, m.mean, kappa, cylinder);
  }
  if (type.boundary == BoundaryType::rectangle) {  // step 6: re-centred along the axis
    const T along = dot<T>(placed.x, Vector3<T>(m.mean - placed.c));
    placed.c += scaled<T>(placed.x, along);
  }
  const T v_x = m.about(placed.c, placed.x, placed.x), v_y = m.about(placed.c, placed.y, placed.y);
  if (type.boundary == BoundaryType::circle) {
    placed.d[0] = circle<T>(v_x, v_y, scale.circle, scale.larger_axis);  // step 7
  } else {
    const double factor = type.boundary == BoundaryType::rectangle ? scale.rectangle : scale.ellipse;
    placed.d = {root<T>(v_x, factor), root<T>(v_y, factor)};  // steps 6 and 8
  }
  return placed;
}

template <class T>
Vector3<double> value(const Vector3<T>& v) {
  return {v[0].value(), v[1].value(), v[2].value()};
}
Eigen::Matrix<double, 3, joint_size> slope(const Vector3<Dual>& v) {
  Eigen::Matrix<double, 3, joint_size> J;
  for (int i = 0; i < 3; ++i) J.row(i) = v[i].derivatives().transpose();
  return J;
}

// The frame fixed in the moving axes of the surface, seen from its axes at rest: R(w) v, and R(w) c + t.
void carry_along(Placed<Dual>& placed, const Vector3<Dual>& w, const Vector3<Dual>& t) {
  for (Vector3<Dual>* axis : {&placed.x, &placed.y, &placed.z}) *axis += cross<Dual>(w, *axis);
  placed.c += cross<Dual>(w, placed.c) + t;
}

// d (d, k, w or tilt, t) / d (chart, moments) (fitting.md section 1.3: a new frame from unit vectors).
Eigen::Matrix<double, Eigen::Dynamic, joint_size, 0, 11, joint_size> J_local(const Placed<Dual>& placed,
                                                                             const PatchTypeRow& type) {
  Eigen::Matrix<double, Eigen::Dynamic, joint_size, 0, 11, joint_size> J(type.size(), joint_size);
  J.setZero();
  for (int i = 0; i < type.boundary_size; ++i) J.row(i) = placed.d[i].derivatives().transpose();
  for (int i = 0; i < type.curvature_size; ++i) J(type.curvature_at() + i, i) = 1.0;
  const Vector3d x = value(placed.x), y = value(placed.y), z = value(placed.z);
  J.row(type.rotation_at()) = -y.transpose() * slope(placed.z);
  J.row(type.rotation_at() + 1) = x.transpose() * slope(placed.z);
  if (!type.revolute()) J.row(type.rotation_at() + 2) = y.transpose() * slope(placed.x);
  const Matrix3d axes = (Matrix3d() << x, y, z).finished();
  J.middleRows(type.position_at(), 3) = axes.transpose() * slope(placed.c);
  return J;
}

struct JointState {
  Dual kappa;
  Vector3<Dual> w, t;
  Eigen::Matrix<Dual, moments_size, 1> moments;
};

JointState seeded(const SurfaceFit& fit, const MomentVector& moments) {
  const auto variable = [](double at, int index) { return Dual(at, joint_size, index); };
  JointState state;
  state.kappa = variable(fit.state.k[0], 0);
  for (int i = 0; i < 3; ++i) {
    state.w[i] = variable(0.0, 2 + i);
    state.t[i] = variable(0.0, 5 + i);
  }
  for (int i = 0; i < moments_size; ++i) state.moments[i] = variable(moments[i], moments_at + i);
  return state;
}

}  // namespace

BoundaryScale extent_scale(double containment) {
  const double root_gamma = std::sqrt(containment);
  return {.ellipse = 2.0 * root_gamma,
          .circle = 2.0 * root_gamma,
          .rectangle = std::sqrt(3.0) * root_gamma,
          .plane_ellipse = 2.0 * root_gamma,
          .plane_circle = 2.0 * root_gamma,
          .plane_rectangle = std::sqrt(3.0) * root_gamma};
}

BoundaryScale paper_scale(double containment) {
  const double lambda = two_sided_normal_quantile(containment);  // step 4
  const double l = std::sqrt(-2.0 * std::log1p(-containment));   // Eq. (30)
  return {.ellipse = lambda,
          .circle = lambda,
          .rectangle = lambda,
          .plane_ellipse = l,
          .plane_circle = l,
          .plane_rectangle = l,
          .larger_axis = true};
}

Patch bounded_patch(const Samples& samples, const SurfaceFit& fit, const PatchTypeRow& type,
                    const MomentVector& moments, const JointMatrix& cov_joint, const BoundaryScale& scale,
                    Apex apex, const std::optional<PlaneDirection>& direction) {
  const JointState state = seeded(fit, moments);
  Placed<Dual> placed = place<Dual>(state.kappa, unpack<Dual>(state.moments), type, scale, apex, direction);
  carry_along(placed, state.w, state.t);
  const auto J = J_local(placed, type);
  PatchMatrix cov_local = J * cov_joint * J.transpose();
  if (direction) cov_local(type.rotation_at() + 2, type.rotation_at() + 2) += direction->variance;
  Boundary bound{type.boundary, BoundaryVector(type.boundary_size)};
  for (int i = 0; i < type.boundary_size; ++i) bound.d[i] = placed.d[i].value();
  const Matrix3d axes = (Matrix3d() << value(placed.x), value(placed.y), value(placed.z)).finished();
  const Vector3d c = samples.origin + fit.state.c + fit.state.R * value(placed.c);
  return make_patch(type, bound, fit.state.k.head(type.curvature_size), fit.state.R * axes, c,
                    PatchMatrix(0.5 * (cov_local + cov_local.transpose())));
}

}  // namespace patchlab
