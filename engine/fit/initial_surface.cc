#include "engine/fit/initial_surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/fit/sample_rows.h"
#include "engine/fit/solve_least.h"

namespace patchlab {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Vector6 monomials(double x, double y) { return {1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y}; }

// Weighted sums of one height field, in coordinates divided by `size` so that they are well scaled.
struct HeightSums {
  Matrix6 A = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  double size;

  void add(const Vector3d& q, double weight) {
    const Vector6 row = monomials(q.x() / size, q.y() / size);
    A.noalias() += weight * row * row.transpose();
    b.noalias() += weight * (q.z() / size) * row;
  }
  Vector6 solve() const {
    Vector6 a = solve_least(A, b);
    a[0] *= size;
    a.tail<3>() /= size;
    return a;
  }
};

struct alignas(64) LaneBlock {
  double number[block_size];
};
constexpr LaneBlock zeros = {};
constexpr LaneBlock ones = [] {
  LaneBlock block{};
  for (double& number : block.number) number = 1.0;
  return block;
}();

// Sums of robust weights w over all samples: w q q', w q and w.
struct Mass {
  Matrix3d second;
  Vector3d first;
  double weight;

  Vector3d mean() const { return first / weight; }
  Matrix3d scatter() const { return second - first * mean().transpose(); }
};

void weigh_points(const Samples& samples, std::size_t block, RowBlock& rows) {
  for (std::size_t i = 0; i < block_size; ++i) {
    const std::size_t sample = block * block_size + i;
    const double s = sample < samples.size() ? std::sqrt(samples.robust[sample]) : 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) rows.row[axis][i] = s * samples.blocks[block].q[axis][i];
    rows.row[3][i] = s;
  }
}

NormalEquations mass_of_part(const Samples& samples, const Chunk& part) {
  RowBlock rows;
  RowSums sums;
  for (std::size_t b = part.first; b < part.last; ++b) {
    const auto& q = samples.blocks[b].q;
    const double *whole[] = {q[0], q[1], q[2], ones.number, zeros.number, zeros.number},
                 *weighed[] = {rows.row[0], rows.row[1],  rows.row[2],
                               rows.row[3], zeros.number, zeros.number};
    const bool as_they_are =
        (b + 1) * block_size <= samples.size() && samples.all_count(b * block_size, block_size);
    if (!as_they_are) weigh_points(samples, b, rows);
    fastest_rows().add(as_they_are ? whole : weighed, 4, block_size, sums);
  }
  return normal_equations(sums, 3);
}

Mass mass(const Samples& samples) {
  if (samples.all_count(0, samples.size())) {
    return {samples.scatter, Vector3d::Zero(), static_cast<double>(samples.size())};
  }
  const NormalEquations sums =
      sum_of_parts(samples.blocks.size(), [&](const Chunk& part) { return mass_of_part(samples, part); });
  return {sums.A, sums.b, sums.chi2};
}

double weight_along(const Matrix3d& cov, const Vector3d& normal) {
  return 1.0 / std::max(normal.dot(cov * normal), 1e-12 * cov.trace() + 1e-300);
}

HeightFrame height_frame(const SurfaceState& frame, double size) {
  HeightFrame heights{{}, size};
  for (Eigen::Index i = 0; i < 3; ++i) {
    heights.frame.c[i] = frame.c[i];
    for (Eigen::Index j = 0; j < 3; ++j) heights.frame.R[i][j] = frame.R(i, j);
  }
  return heights;
}

// Of many samples a quarter tells a start as well; not always the same columns of a scan's rows.
bool tells_start(std::size_t block, std::size_t blocks) {
  constexpr std::size_t many = 16, share = 4;
  return blocks < many || block % share == block / share % share;
}

NormalEquations height_equations(const Samples& samples, const HeightFrame& heights, const Chunk& part) {
  constexpr int monomials = 6;
  RowBlock rows;
  const double* columns[row_count];
  std::fill(std::begin(columns), std::end(columns), zeros.number);
  for (std::size_t row = 0; row <= monomials; ++row) columns[row] = rows.row[row];
  RowSums sums;
  for (std::size_t b = part.first; b < part.last; ++b) {
    if (!tells_start(b, samples.blocks.size())) continue;
    const std::size_t at = b * block_size, count = std::min(block_size, samples.size() - at);
    LaneBlock share = ones;
    if (count < block_size || !samples.all_count(at, count)) {
      share = zeros;
      for (std::size_t i = 0; i < count; ++i)
        share.number[i] = samples.robust[at + i] * samples.bends[at + i];
    }
    const std::size_t lanes = whole_lanes(count);
    fastest_rows().heights(heights, samples.blocks[b], share.number, lanes, rows);
    fastest_rows().add(columns, monomials + 1, lanes, sums);
  }
  return normal_equations(sums, monomials);
}

Vector6 fit_heights(const Samples& samples, const SurfaceState& frame) {
  const double size = samples.extent;
  const HeightFrame heights = height_frame(frame, size);
  const NormalEquations equations = sum_of_parts(
      samples.blocks.size(), [&](const Chunk& part) { return height_equations(samples, heights, part); });
  return HeightSums{equations.A, equations.b, size}.solve();
}

SurfaceState reframed(const SurfaceState& frame, const Vector6& a) {
  SurfaceState next = frame;
  next.c = frame.c + a[0] * frame.R.col(2);
  next.R = turned_to(frame.R, frame.R * Vector3d(-a[1], -a[2], 1.0).normalized());
  return next;
}

// Axes along the principal directions of the shape operator, |k_x| <= |k_y|.
SurfaceState principal(const SurfaceState& frame, const Vector6& a) {
  const double mean = 0.5 * (a[3] + a[5]), apart = std::hypot(0.5 * (a[3] - a[5]), a[4]);
  const double of_larger = 0.5 * std::atan2(2.0 * a[4], a[3] - a[5]);
  const bool x_is_larger = std::abs(mean + apart) < std::abs(mean - apart);
  const double angle = x_is_larger ? of_larger : of_larger + 0.5 * std::numbers::pi;
  SurfaceState state = frame;
  state.R.col(0) = frame.R.leftCols<2>() * Vector2d(std::cos(angle), std::sin(angle));
  state.R.col(1) = frame.R.col(2).cross(state.R.col(0));
  state.k = x_is_larger ? Vector2d(mean + apart, mean - apart) : Vector2d(mean - apart, mean + apart);
  return state;
}

// |q|^2 = 2 m'q + s by linear least squares: a sphere's centre m, as a state with its apex over the mean.
SurfaceState algebraic_sphere(const Samples& samples, const SurfaceState& near) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  const double size = samples.extent;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector4d row = (samples.q(i) / size).homogeneous();
    const double weight = samples.robust[i] * samples.bends[i] * weight_along(samples.cov(i), near.R.col(2));
    A.noalias() += weight * row * row.transpose();
    b.noalias() += weight * (samples.q(i) / size).squaredNorm() * row;
  }
  const Eigen::Vector4d solution = solve_least(A, b);
  const Vector3d centre = 0.5 * solution.head<3>() * size;
  const double radius = std::sqrt(std::max(size * size * solution[3] + centre.squaredNorm(), 1e-300));
  const Vector3d towards = (centre - mass(samples).mean()).normalized();  // from the surface to the centre
  const double side = towards.dot(near.R.col(2)) >= 0.0 ? 1.0 : -1.0;
  SurfaceState state;
  state.R = turned_to(near.R, side * towards);
  state.k = {side / radius, 0.0};
  state.c = centre - radius * towards;
  return state;
}

// Circular cylinders along the principal axes of the points, each by an algebraic circle across its axis:
// what points all round a can or a pipe ask for, where no height field exists. The apex lies on the side of
// the points, z_l towards the viewpoint.
std::array<SurfaceState, 3> algebraic_cylinders(const Samples& samples) {
  const Mass all = mass(samples);
  const Vector3d mean = all.mean();
  const Matrix3d axes = Eigen::SelfAdjointEigenSolver<Matrix3d>(all.scatter()).eigenvectors();
  const double size = samples.extent;
  std::array<SurfaceState, 3> cylinders;
  for (int i = 0; i < 3; ++i) {
    Eigen::Matrix<double, 3, 2> across;
    across << axes.col((i + 1) % 3), axes.col((i + 2) % 3);
    Matrix3d A = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    for (std::size_t j = 0; j < samples.size(); ++j) {
      const Vector2d u = across.transpose() * (samples.q(j) - mean) / size;
      A += samples.robust[j] * u.homogeneous() * u.homogeneous().transpose();
      b += samples.robust[j] * u.squaredNorm() * u.homogeneous();
    }
    const Vector3d solution = solve_least(A, b);
    const Vector2d m = 0.5 * size * solution.head<2>();
    const double radius = std::sqrt(std::max(size * size * solution[2] + m.squaredNorm(), 1e-300));
    const Vector3d centre = mean + across * m;
    const bool all_round = m.norm() < 0.1 * radius;
    const Vector2d outward =
        all_round ? Vector2d(across.transpose() * (samples.viewpoint(0) - centre)) : Vector2d(-m);
    const Vector3d z = across * (outward.norm() > 0.0 ? Vector2d(outward.normalized()) : Vector2d(1.0, 0.0));
    SurfaceState state;
    state.c = centre + radius * z;
    const double side = z.dot(samples.viewpoint(0) - state.c) < 0.0 ? -1.0 : 1.0;
    state.R.col(0) = axes.col(i);
    state.R.col(2) = side * z;
    state.R.col(1) = state.R.col(2).cross(state.R.col(0));
    state.k = {-side / radius, 0.0};
    cylinders[static_cast<std::size_t>(i)] = state;
  }
  return cylinders;
}

SurfaceState quarter_turned(const SurfaceState& state) {
  SurfaceState turned = state;
  turned.R.col(0) = state.R.col(1);
  turned.R.col(1) = -state.R.col(0);
  turned.k = {state.k[1], state.k[0]};
  return turned;
}

SurfaceState with_k(SurfaceState state, double k) {
  state.k = {k, 0.0};
  return state;
}

}  // namespace

Matrix3d turned_to(const Matrix3d& R, const Vector3d& normal) { return shortest_turn(R.col(2), normal) * R; }

SurfaceState initial_plane(const Samples& samples) {
  const Mass all = mass(samples);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(all.scatter());
  SurfaceState plane;
  plane.c = all.mean();
  plane.R.col(0) = eigen.eigenvectors().col(2);
  plane.R.col(2) = eigen.eigenvectors().col(0);
  const double facing = plane.R.col(2).dot(samples.mean_viewpoint() - plane.c);
  if (facing < 0.0) plane.R.col(2) *= -1.0;
  plane.R.col(1) = plane.R.col(2).cross(plane.R.col(0));
  return plane;
}

SurfaceState height_field(const Samples& samples, const SurfaceState& frame) {
  constexpr double level = 0.1;  // slopes that change the curvatures by a hundredth
  Vector6 a = fit_heights(samples, frame);
  SurfaceState turned = reframed(frame, a);
  if (a.segment<2>(1).norm() < level) return principal(turned, a);
  a = fit_heights(samples, turned);
  turned.c += a[0] * turned.R.col(2);
  return principal(turned, a);
}

Quadric quadric_through(const Samples& samples, const SurfaceState& frame,
                        const std::vector<std::size_t>& points) {
  HeightSums sums{.size = samples.extent};
  for (const std::size_t i : points) sums.add(to_local(frame, samples.q(i)), 1.0);
  return {frame, sums.solve()};
}

double quadric_residual(const Quadric& quadric, const Samples& samples, std::size_t i) {
  const Vector3d q = to_local(quadric.frame, samples.q(i));
  const Vector6& a = quadric.a;
  const Vector3d g(-a[1] - a[3] * q.x() - a[4] * q.y(), -a[2] - a[4] * q.x() - a[5] * q.y(), 1.0);
  const Vector3d g_world = quadric.frame.R * g;
  return (q.z() - a.dot(monomials(q.x(), q.y()))) * std::sqrt(weight_along(samples.cov(i), g_world));
}

Starts starts(const Samples& samples, const SurfaceModel& model, const SurfaceState& quadratic) {
  const double mean_curvature = 0.5 * quadratic.k.sum();
  switch (model.kind) {
    case ModelKind::plane:
      return {with_k(quadratic, 0.0)};
    case ModelKind::sphere:
      return {with_k(quadratic, mean_curvature), algebraic_sphere(samples, quadratic)};
    case ModelKind::circular_paraboloid:
      return {with_k(quadratic, mean_curvature)};
    case ModelKind::circular_cylinder: {
      Starts all = {with_k(quadratic, quadratic.k[1]), with_k(quarter_turned(quadratic), quadratic.k[0])};
      for (const SurfaceState& closed : algebraic_cylinders(samples)) all.push_back(closed);
      return all;
    }
    case ModelKind::cylindric_paraboloid:
      return {with_k(quadratic, quadratic.k[1]), with_k(quarter_turned(quadratic), quadratic.k[0])};
    case ModelKind::paraboloid:
      return {quadratic};
  }
  return {quadratic};
}

}  // namespace patchlab
