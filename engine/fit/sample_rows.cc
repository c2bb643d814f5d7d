#include "engine/fit/sample_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/base/repeat.h"
#include "engine/patch/surface.h"

namespace patchlab {
namespace {

RowSurface row_surface(const SurfaceModel& model, const SurfaceState& state) {
  const PatchTypeRow& type = *find_patch_type(model.surface, default_boundary(model.surface));
  const Vector3d kappa = k3(model, state.k);
  RowSurface surface{};
  for (Eigen::Index i = 0; i < 3; ++i) {
    surface.c[i] = state.c[i];
    surface.k3[i] = kappa[i];
    for (Eigen::Index j = 0; j < 3; ++j) surface.R[i][j] = state.R(i, j);
    for (Eigen::Index j = 0; j < type.B.cols(); ++j) surface.B[i][j] = type.B(i, j);
  }
  return surface;
}

void put(const Residual& residual, std::size_t i, RowBlock& rows) {
  for (std::size_t row = 0; row < chart_size; ++row) {
    rows.row[row][i] = residual.F_p[static_cast<Eigen::Index>(row)];
  }
  rows.row[chart_size][i] = residual.F;
  for (Eigen::Index axis = 0; axis < 3; ++axis) rows.x[axis][i] = residual.x[axis];
  rows.sigma[i] = std::sqrt(residual.v);
}

double sum_of_lanes(const double (&lane)[lane_count]) {
  return Eigen::Map<const Eigen::Array<double, lane_count, 1>, Eigen::Aligned64>(lane).sum();
}

// The tile of rows i and j of `size` columns and F after them, i <= j, as RowSums has them.
template <int size>
constexpr int tile_of(int i, int j) {
  constexpr int groups = (size + 3) / 3;
  const int first = i / 3 * groups - i / 3 * (i / 3 - 1) / 2;
  return first + j / 3 - i / 3;
}

template <int size = 1>
NormalEquations equations_of(const RowSums& sums, int free_size) {
  if constexpr (size < chart_size) {
    if (free_size != size) return equations_of<size + 1>(sums, free_size);
  }
  NormalEquations equations{0.0, StepMatrix(size, size), StepVector(size)};
  if (sums.empty) {
    equations.A.setZero();
    equations.b.setZero();
    return equations;
  }
  double *A = equations.A.data(), *b = equations.b.data();
  repeat<size + 1>([&](auto i) {
    repeat<size + 1 - i>([&](auto after) {
      constexpr int j = i + after;
      const double sum = sum_of_lanes(sums.tile[tile_of<size>(i, j)][3 * (i % 3) + j % 3]);
      if constexpr (j < size) {
        A[i * size + j] = A[j * size + i] = sum;
      } else if constexpr (i < size) {
        b[i] = sum;
      } else {
        equations.cost = equations.chi2 = sum;
      }
    });
  });
  return equations;
}

}  // namespace

SampleRows::SampleRows(const Samples& samples, const SurfaceModel& model, const SurfaceState& state,
                       Distance distance, const RowKernel& kernel)
    : samples_(samples),
      model_(model),
      state_(state),
      distance_(distance),
      kappa_(k3(model, state.k)),
      kernel_(kernel),
      surface_(row_surface(model, state)) {}

std::size_t SampleRows::count(std::size_t block) const {
  return std::min(block_size, samples_.size() - block * block_size);
}

std::size_t SampleRows::lanes_of(std::size_t block) const { return whole_lanes(count(block)); }

void SampleRows::evaluate(std::size_t block, RowBlock& rows) const {
  const auto kernel = distance_ == Distance::exact ? kernel_.exact : kernel_.paper;
  const bool found = kernel(surface_, samples_.blocks[block], lanes_of(block), rows);
  for (auto& row : rows.row) std::fill(row + count(block), row + lanes_of(block), 0.0);
  for (std::size_t i = 0; !found && i < count(block); ++i) {
    if (rows.failed[i] == 0.0) continue;
    const std::size_t sample = block * block_size + i;
    put(patchlab::residual(distance_, model_, state_, samples_.q(sample), samples_.cov(sample)), i, rows);
  }
}

Residual SampleRows::residual(const RowBlock& rows, std::size_t i) const {
  Residual r;
  for (std::size_t row = 0; row < chart_size; ++row) r.F_p[static_cast<Eigen::Index>(row)] = rows.row[row][i];
  r.F = rows.row[chart_size][i];
  r.x = {rows.x[0][i], rows.x[1][i], rows.x[2][i]};
  r.g = gradient(r.x, kappa_);
  r.v = rows.sigma[i] * rows.sigma[i];
  r.F_q = r.g / rows.sigma[i];
  return r;
}

void SampleRows::add(const RowBlock& rows, std::size_t block, std::span<const int> free,
                     RowSums& sums) const {
  alignas(64) static constexpr double nothing[block_size] = {};
  const double* columns[row_count] = {};
  std::fill(std::begin(columns), std::end(columns), nothing);
  for (std::size_t i = 0; i < free.size(); ++i) columns[i] = rows.row[free[i]];
  columns[free.size()] = rows.row[chart_size];
  kernel_.add(columns, static_cast<int>(free.size()) + 1, lanes_of(block), sums);
}

NormalEquations normal_equations(const RowSums& sums, int free_size) { return equations_of(sums, free_size); }

}  // namespace patchlab
