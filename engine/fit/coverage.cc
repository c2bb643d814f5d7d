#include "engine/fit/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "engine/base/parallel.h"
#include "engine/fit/distance.h"
#include "engine/fit/rows.h"
#include "engine/patch/surface.h"

namespace patchlab {
namespace {

constexpr std::size_t blocks_a_chunk = 16;

// Where normal . u > offset, u lies outside.
struct OuterLine {
  Vector2d normal;
  double offset;
};
// The sides of a quad, or of the box around another outline.
std::array<OuterLine, 4> outer_lines(const Boundary& bound) {
  const Vector2d reach = extent(bound);
  std::array<Vector2d, 4> corners = {reach, {-reach.x(), reach.y()}, -reach, {reach.x(), -reach.y()}};
  if (bound.type == BoundaryType::convex_quad) corners = vertices(bound);
  std::array<OuterLine, 4> lines;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d a = corners[i], along = corners[(i + 1) % 4] - a;
    const Vector2d normal(along.y(), -along.x());
    const double side = normal.dot(a) < 0.0 ? -1.0 : 1.0;  // the origin is inside
    lines[i] = {side * normal, side * normal.dot(a)};
  }
  return lines;
}

// Cells about the patch: what area of each is inside the bound, and the points it holds.
class CellGrid {
 public:
  CellGrid(const Boundary& bound, const Boundary& doubtless, double side, const Vector2d& reach)
      : bound_(bound),
        doubtless_(doubtless),
        lines_(outer_lines(bound)),
        side_(side),
        columns_(count(reach.x())),
        rows_(count(reach.y())) {
    inside_.resize(static_cast<std::size_t>(columns_ * rows_));
    outside_ = inside_;
  }
  void add(const Vector2d& u, double points) {
    const int column = cell(u.x(), columns_), row = cell(u.y(), rows_);
    if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return;
    auto& counts = contains(doubtless_, u) ? inside_ : outside_;
    counts[static_cast<std::size_t>(row * columns_ + column)] += points;
  }
  double score(double expected_per_cell) const {
    int good = 0, counted = 0;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const auto at = static_cast<std::size_t>(row * columns_ + column);
        const double share = share_inside(column, row);
        if (share == 0.0 && outside_[at] == 0.0) continue;
        ++counted;
        const bool filled = inside_[at] >= std::round(0.5 * share * expected_per_cell);
        const bool kept = outside_[at] <= std::round(0.5 * (1.0 - share) * expected_per_cell);
        if (filled && kept) ++good;
      }
    }
    return counted == 0 ? 0.0 : static_cast<double>(good) / counted;
  }

 private:
  // Of an outline that reaches farther, the middle is looked at: no number of points fills so many cells.
  static constexpr double most_each_side = 500.0;

  // Written so that NaN is `most_each_side` too.
  int count(double reach) const {
    const double cells = std::ceil(reach / side_);
    return 2 * static_cast<int>(cells < most_each_side ? cells : most_each_side);
  }
  int cell(double u, int cells) const {
    const double at = std::floor(u / side_);
    return std::abs(at) <= most_each_side ? static_cast<int>(at) + cells / 2 : -1;
  }
  // Beyond one of the straight lines that the outline lies between.
  bool is_beyond(int column, int row) const {
    const Vector2d middle = side_ * Vector2d(column - columns_ / 2 + 0.5, row - rows_ / 2 + 0.5);
    return std::ranges::any_of(lines_, [&](const OuterLine& line) {
      return line.normal.dot(middle) - 0.5 * side_ * line.normal.lpNorm<1>() > line.offset;
    });
  }
  double share_inside(int column, int row) const {
    constexpr int fine = 6;
    if (is_beyond(column, row)) return 0.0;
    int hits = 0;
    for (int i = 0; i < fine * fine; ++i) {
      const double x = column - columns_ / 2 + (i % fine + 0.5) / fine,
                   y = row - rows_ / 2 + (i / fine + 0.5) / fine;
      hits += contains(bound_, Vector2d(side_ * x, side_ * y)) ? 1 : 0;
    }
    return hits / static_cast<double>(fine * fine);
  }

  Boundary bound_, doubtless_;  // outside the latter is outside beyond the outline's own doubt
  std::array<OuterLine, 4> lines_;
  double side_;
  int columns_, rows_;
  std::vector<double> inside_, outside_;
};

// The outline with every length longer by two of its standard deviations.
Boundary beyond_doubt(const Patch& patch) {
  Boundary grown = boundary(patch);
  if (!patch.covariance_local) return grown;
  const Eigen::Index lengths = grown.type == BoundaryType::convex_quad ? 4 : grown.d.size();
  for (Eigen::Index i = 0; i < lengths; ++i) {
    grown.d[i] += 2.0 * std::sqrt(std::max((*patch.covariance_local)(i, i), 0.0));
  }
  return grown;
}

// The outline as a closed curve on the surface.
std::vector<Vector3d> rim(const Boundary& bound, const Vector3d& kappa) {
  constexpr int points = 128;
  std::vector<Vector3d> curve;
  for (const Vector2d& u : outline(bound, points)) curve.emplace_back(u.x(), u.y(), height(u, kappa));
  return curve;
}

double squared_distance(const Vector3d& q, const std::vector<Vector3d>& curve) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vector3d &a = curve[i], along = curve[(i + 1) % curve.size()] - a;
    const double s = std::clamp(along.dot(q - a) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (q - a - s * along).squaredNorm());
  }
  return least;
}

// The feet of points on the surface of a patch, nearest in metres, a block at a time.
class Feet {
 public:
  explicit Feet(const Vector3d& kappa) : kappa_(kappa) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      surface_.R[axis][axis] = 1.0;
      surface_.k3[axis] = kappa[static_cast<Eigen::Index>(axis)];
    }
    for (const std::size_t diagonal : {0U, 3U, 5U}) std::ranges::fill(points_.cov[diagonal], 1.0);
  }
  void find(std::span<const Vector3d> points) {
    for (std::size_t i = 0; i < block_size; ++i) {
      const Vector3d& q = points[std::min(i, points.size() - 1)];
      for (std::size_t axis = 0; axis < 3; ++axis) points_.q[axis][i] = q[static_cast<Eigen::Index>(axis)];
    }
    const bool found = fastest_rows().exact(surface_, points_, block_size, rows_);
    for (std::size_t i = 0; !found && i < points.size(); ++i) {
      if (rows_.failed[i] == 0.0) continue;
      const Vector3d x = foot_point(points[i], Matrix3d::Identity(), kappa_).x;
      for (std::size_t axis = 0; axis < 3; ++axis) rows_.x[axis][i] = x[static_cast<Eigen::Index>(axis)];
    }
  }
  Vector3d operator[](std::size_t i) const { return {rows_.x[0][i], rows_.x[1][i], rows_.x[2][i]}; }

 private:
  Vector3d kappa_;
  RowSurface surface_{};
  SampleBlock points_{};
  RowBlock rows_;
};

}  // namespace

double coverage(const Patch& patch, const std::vector<Vector3d>& feet_patch,
                const std::vector<double>& weights) {
  constexpr double points_per_cell = 12.0, most_cells = 50.0;
  const Boundary bound = boundary(patch);
  const auto used =
      static_cast<double>(std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0.0; }));
  const double cells = std::clamp(used / points_per_cell, 4.0, most_cells);
  const double side = std::sqrt(area(bound) / cells);
  if (!(side > 0.0 && std::isfinite(side))) return 0.0;
  Vector2d reach = extent(bound);
  for (std::size_t i = 0; i < feet_patch.size(); ++i) {
    if (weights[i] > 0.0) reach = reach.cwiseMax(feet_patch[i].head<2>().cwiseAbs());
  }
  reach = reach.cwiseMin(3.0 * extent(bound));
  CellGrid grid(bound, beyond_doubt(patch), side, reach);
  for (std::size_t i = 0; i < feet_patch.size(); ++i) {
    if (weights[i] > 0.0) grid.add(feet_patch[i].head<2>(), used * weights[i]);
  }
  return grid.score(used / cells);
}

double distance_rms(const Patch& patch, const std::vector<Vector3d>& points_patch,
                    const std::vector<double>& weights) {
  const Boundary bound = boundary(patch);
  const Vector3d kappa = k3(patch);
  const std::vector<Vector3d> curve = rim(bound, kappa);
  std::vector<double> squares(points_patch.size());
  for_each_chunk(points_patch.size(), blocks_a_chunk * block_size, [&](const Chunk& chunk) {
    Feet feet(kappa);
    for (std::size_t first = chunk.first; first < chunk.last; first += block_size) {
      const std::span block(points_patch.data() + first, std::min(block_size, chunk.last - first));
      feet.find(block);
      for (std::size_t i = 0; i < block.size(); ++i) {
        if (weights[first + i] == 0.0) continue;
        const Vector3d &q = block[i], x = feet[i];
        squares[first + i] =
            contains(bound, x.head<2>()) ? (q - x).squaredNorm() : squared_distance(q, curve);
      }
    }
  });
  const auto count = std::ranges::count_if(weights, [](double weight) { return weight != 0.0; });
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(std::max<std::ptrdiff_t>(count, 1)));
}

}  // namespace patchlab
