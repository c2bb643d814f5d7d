#include "engine/fit/moment_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace patchlab {
namespace {

// Where the monomials of the kernels are, by the axes they are made of, and the moments.
constexpr int first_at[3] = {1, 2, 6}, second_at[3][3] = {{3, 4, 7}, {4, 5, 8}, {7, 8, 9}};
constexpr int noise_at[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};
constexpr int axes_of[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};  // of second moments
constexpr int motion_rows = 9, most_monomials = 12;

// Where each moment is among the monomials.
int monomial_of(int moment) {
  if (moment < 3) return first_at[moment];
  const auto& axes = axes_of[moment - 3];
  return second_at[axes[0]][axes[1]];
}

// Which rows there are, how many groups of three of them are filled.
struct Shape {
  bool plain, with_z;

  int axes() const { return with_z ? 3 : 2; }
  int noise() const { return with_z ? 6 : 3; }
  int monomials() const { return with_z ? most_monomials : flat_monomials; }
  int shared() const { return with_z ? 9 : 6; }  // rows of plain projections that meet the fit
  int weighing() const { return with_z || plain ? most_monomials : flat_monomials; }
  int linear() const { return with_z ? 6 : 3; }  // 1 x y (z 0 0)
  int weighted() const { return with_z ? 9 : 5; }
};

// Sums of products as the kernels make them.
struct RawSums {
  double noise[6][most_monomials], weight[3][most_monomials], motion[3 * motion_rows][6], shared[9][9];
  MomentMatrix weighted;  // w^2 phi phi', in the order of the monomials without the first
  ChartMatrix fit;        // of F_p

  void operator+=(const RawSums& other);
};

template <std::size_t rows, std::size_t columns>
void add(double (&to)[rows][columns], const double (&from)[rows][columns]) {
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) to[i][j] += from[i][j];
  }
}
void RawSums::operator+=(const RawSums& other) {
  add(noise, other.noise);
  add(weight, other.weight);
  add(motion, other.motion);
  add(shared, other.shared);
  weighted += other.weighted;
  fit += other.fit;
}

template <std::size_t rows, std::size_t columns>
void put(const MomentTile* tiles, int a_count, int b_count, double (&to)[rows][columns]) {
  for (int i = 0; i < a_count; i += 3) {
    for (int j = 0; j < b_count; j += 3, ++tiles) {
      for (int k = 0; k < 9; ++k) to[i + k / 3][j + k % 3] = sum_of(*tiles, k);
    }
  }
}

void put(const RowSums& squares, int n, MomentMatrix& to) {
  const NormalEquations all_but_last = normal_equations(squares, n - 1);
  to.topLeftCorner(n - 1, n - 1) = all_but_last.A;
  to.col(n - 1).head(n - 1) = all_but_last.b;
  to.row(n - 1).head(n - 1) = all_but_last.b.transpose();
  to(n - 1, n - 1) = all_but_last.chi2;
}

template <std::size_t rows>
std::array<const double*, rows> pointers(const double (&from)[rows][block_size]) {
  std::array<const double*, rows> all;
  for (std::size_t i = 0; i < rows; ++i) all[i] = from[i];
  return all;
}

// The running sums of one part.
class Sums {
 public:
  Sums(const Shape& shape, const MomentKernel& kernel, const RowKernel& rows)
      : shape_(shape), kernel_(kernel), rows_(rows) {}

  void add(const MomentRows& rows, const RowBlock& of_fit, std::size_t count) {
    const auto noise = pointers(rows.noise);
    const auto weight = pointers(rows.weight);
    const auto monomial = pointers(rows.monomial);
    const auto motion = pointers(rows.motion);
    const double* linear[6] = {monomial[0], monomial[1],  monomial[2],
                               monomial[6], monomial[10], monomial[11]};
    kernel_.add(noise.data(), shape_.noise(), monomial.data(), shape_.monomials(), count, noise_.data());
    kernel_.add(weight.data(), 3, monomial.data(), shape_.weighing(), count, weight_.data());
    if (shape_.plain) {
      const auto fit = pointers(of_fit.row);  // the last is F: its sums are not asked for
      kernel_.add(motion.data(), shape_.shared(), fit.data(), 9, count, motion_.data());
    } else {
      kernel_.add(motion.data(), shape_.axes() * motion_rows, linear, shape_.linear(), count, motion_.data());
      const auto weighted = pointers(rows.weighted);
      rows_.add(weighted.data(), shape_.weighted(), count, weighted_);
    }
  }
  RawSums raw(const RowSums& fit, const SurfaceModel& model) const {
    RawSums sums{};
    sums.weighted.setZero();
    put(noise_.data(), shape_.noise(), shape_.monomials(), sums.noise);
    put(weight_.data(), 3, shape_.weighing(), sums.weight);
    if (shape_.plain) {
      put(motion_.data(), shape_.shared(), 9, sums.shared);
    } else {
      put(motion_.data(), shape_.axes() * motion_rows, shape_.linear(), sums.motion);
      put(weighted_, shape_.weighted(), sums.weighted);
    }
    sums.fit = spread(model, normal_equations(fit, model.free_size).A);
    return sums;
  }

 private:
  const Shape& shape_;
  const MomentKernel& kernel_;
  const RowKernel& rows_;
  std::array<MomentTile, 8> noise_;
  std::array<MomentTile, 4> weight_;
  std::array<MomentTile, 18> motion_;
  RowSums weighted_;
};

// Rows of the fit as they count: by the root of their weight.
void weigh_fit(const Samples& samples, std::size_t block, std::size_t count, RowBlock& rows) {
  const std::size_t first = block * block_size;
  if (samples.all_count(first, count)) return;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = std::sqrt(samples.robust[first + i]) * samples.bends[first + i];
    for (auto& row : rows.row) row[i] = s > 0.0 ? s * row[i] : 0.0;
  }
}
// By the root of their share of variance.
void weigh_fit(const double* share, std::size_t count, RowBlock& rows) {
  for (std::size_t i = 0; i < count; ++i) {
    for (auto& row : rows.row) row[i] *= std::sqrt(share[i]);
  }
}

RawSums sums_of_part(const Samples& samples, const SurfaceFit& fit, const SampleRows& rows,
                     const Shape& shape, const MomentKernel& kernel, const Chunk& part, FootPoints& feet) {
  const Footprints footprints(samples, rows, fit.state, kernel);
  Sums sums(shape, kernel, fastest_rows());
  RowSums of_fit;
  RowBlock block;
  MomentRows moments;
  alignas(64) double weight[block_size];
  for (std::size_t b = part.first; b < part.last; ++b) {
    const std::size_t count = rows.count(b), lanes = rows.lanes_of(b);
    rows.evaluate(b, block);
    settle_padding(count, block);
    if (shape.plain) {
      footprints.count(b, weight);
    } else {
      footprints.weigh(b, block, weight);
    }
    put_feet(block, weight, b, count, feet);
    const SampleBlock& of_block = samples.blocks[b];
    (shape.plain ? kernel.plain : kernel.feet)(rows.surface(), of_block, block, weight, lanes, shape.with_z,
                                               moments);
    weigh_fit(samples, b, count, block);
    sums.add(moments, block, lanes);
    if (shape.plain && of_block.thin) weigh_fit(moments.share, count, block);
    rows.add(block, b, fit.model.free_indices(), of_fit);
  }
  return sums.raw(of_fit, fit.model);
}

MomentVector by_moment(const double (&of_monomials)[most_monomials]) {
  MomentVector m;
  for (int i = 0; i < moments_size; ++i) m[i] = of_monomials[monomial_of(i)];
  return m;
}

// J X J' summed, X = w^2 X_q S X_q'; of two second moments ab and cd the sum of X_ac x_b x_d with a, b and c,
// d in either order.
MomentMatrix noise_of_moments(const RawSums& sums) {
  const auto E = [&](int a, int c, int monomial) { return sums.noise[noise_at[a][c]][monomial]; };
  MomentMatrix G;
  for (int a = 0; a < 3; ++a) {
    for (int c = 0; c < 3; ++c) G(a, c) = E(a, c, 0);
    for (int k = 0; k < 6; ++k) {
      const auto [c, d] = axes_of[k];
      G(3 + k, a) = G(a, 3 + k) = E(a, c, first_at[d]) + E(a, d, first_at[c]);
    }
  }
  for (int i = 0; i < 6; ++i) {
    const auto [a, b] = axes_of[i];
    for (int k = 0; k < 6; ++k) {
      const auto [c, d] = axes_of[k];
      G(3 + i, 3 + k) = E(a, c, second_at[b][d]) + E(a, d, second_at[b][c]) + E(b, c, second_at[a][d]) +
                        E(b, d, second_at[a][c]);
    }
  }
  return G;
}

// w^2 (phi - m)(phi - m)', summed.
MomentMatrix sampling_of_moments(const RawSums& sums, const MomentVector& mean) {
  const MomentVector squared = by_moment(sums.weight[1]);
  MomentMatrix G =
      sums.weight[1][0] * mean * mean.transpose() - mean * squared.transpose() - squared * mean.transpose();
  for (int i = 0; i < moments_size; ++i) {
    for (int j = 0; j < moments_size; ++j) G(i, j) += sums.weighted(monomial_of(i) - 1, monomial_of(j) - 1);
  }
  return G;
}

// How the moments of foot points move with the surface.
MomentChartMatrix motion_of_moments(const RawSums& sums) {
  constexpr int linear_at[3] = {1, 2, 3};  // of x y z
  MomentChartMatrix M;
  for (int j = 0; j < chart_size; ++j) {
    const auto N = [&](int axis, int monomial) { return sums.motion[motion_rows * axis + j][monomial]; };
    for (int a = 0; a < 3; ++a) M(a, j) = N(a, 0);
    for (int k = 0; k < 6; ++k) {
      const auto [a, b] = axes_of[k];
      M(3 + k, j) = N(a, linear_at[b]) + N(b, linear_at[a]);
    }
  }
  return M;
}

// The same of samples themselves, which stay while the axes move: sum of w J ([x]x, -I).
MomentChartMatrix motion_of_samples(const RawSums& sums) {
  const auto& m = sums.weight[0];
  Matrix3d second;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) second(a, b) = m[second_at[a][b]];
  }
  const Vector3d first(m[first_at[0]], m[first_at[1]], m[first_at[2]]);
  MomentChartMatrix M = MomentChartMatrix::Zero();
  M.block<3, 3>(0, 2) = skew(first);
  M.block<3, 3>(0, 5) = -m[0] * Matrix3d::Identity();
  for (int k = 0; k < 6; ++k) {
    const auto [a, b] = axes_of[k];
    M.block<1, 3>(3 + k, 2) = skew(second.col(b)).row(a) + skew(second.col(a)).row(b);
    M(3 + k, 5 + a) -= first[b];
    M(3 + k, 5 + b) -= first[a];
  }
  return M;
}

ProjectedSamples of_sums(const RawSums& sums, const Shape& shape, FootPoints feet) {
  const double scale = 1.0 / sums.weight[0][0];
  ProjectedSamples projected{std::move(feet), scale * by_moment(sums.weight[0]), {}};
  scale_weights(scale, projected.feet);
  JointMatrix& G = projected.sums.G;
  G.topLeftCorner<chart_size, chart_size>() = sums.fit;
  MomentMatrix of_moments = noise_of_moments(sums);
  if (shape.plain) {
    for (int i = 0; i < moments_size; ++i) {
      for (int j = 0; j < chart_size; ++j) G(moments_at + i, j) = scale * sums.shared[monomial_of(i) - 1][j];
    }
  } else {
    of_moments += sampling_of_moments(sums, projected.moments);
  }
  G.bottomRightCorner<moments_size, moments_size>() = scale * scale * of_moments;
  projected.sums.M = scale * (shape.plain ? motion_of_samples(sums) : motion_of_moments(sums));
  return projected;
}

bool kernels_know(const JointOptions& options) {
  if (options.plane != nullptr) return false;
  const bool feet = options.distance == Distance::exact && options.projection == Projection::foot_points;
  const bool plain = options.distance == Distance::paper && options.projection == Projection::plain;
  return (feet && options.sampling) || (plain && !options.sampling);
}

}  // namespace

FootPoints plain_projection(const Samples& samples, const SurfaceFit& fit) {
  FootPoints feet = room_for_feet(samples);
  const SampleRows rows(samples, fit.model, fit.state, Distance::paper);
  for_each_residual(rows, [&](std::size_t i, const Residual& r) {
    feet.x[i] = r.x;
    feet.F[i] = r.F;
    feet.weight[i] = samples.robust[i] > 0.0 ? 1.0 : 0.0;
  });
  scale_weights(1.0 / std::accumulate(feet.weight.begin(), feet.weight.end(), 0.0), feet);
  return feet;
}

ProjectedSamples project(const Samples& samples, const SurfaceFit& fit, const JointOptions& options,
                         const MomentKernel& kernel) {
  if (!kernels_know(options)) {
    FootPoints feet =
        options.projection == Projection::plain ? plain_projection(samples, fit) : foot_points(samples, fit);
    const MomentVector m = moments(feet.x, feet.weight);
    const JointSums sums = joint_sums(samples, fit, feet, options);
    return {std::move(feet), m, sums};
  }
  const SampleRows rows(samples, fit.model, fit.state, options.distance);
  const Shape shape{options.projection == Projection::plain, k3(fit.model, fit.state.k).z() != 0.0};
  FootPoints feet = room_for_feet(samples);
  const RawSums sums = sum_over_parts<RawSums>(rows.blocks(), [&](const Chunk& part) {
    return sums_of_part(samples, fit, rows, shape, kernel, part, feet);
  });
  return of_sums(sums, shape, std::move(feet));
}

}  // namespace patchlab
