#include "engine/fit/coverage.h"

#include <algorithm>
#include <cmath>

#include "engine/fit/inside_outline.h"

namespace patchlab {
namespace {

// Cells about the patch: what area of each is inside the bound, and the points it holds.
class CellGrid {
 public:
  CellGrid(const Boundary& bound, const Boundary& doubtless, double side, const Vector2d& reach)
      : bound_(bound),
        doubtless_(doubtless),
        side_(side),
        inverse_(1.0 / side),
        columns_(count(reach.x())),
        rows_(count(reach.y())) {
    inside_.resize(static_cast<std::size_t>(columns_ * rows_));
    outside_ = inside_;
  }
  void add(const Vector2d& u, double points) {
    const int column = cell(u.x(), columns_), row = cell(u.y(), rows_);
    if (column < 0 || row < 0) return;
    auto& counts = doubtless_.contains(u.x(), u.y()) ? inside_ : outside_;
    counts[static_cast<std::size_t>(row * columns_ + column)] += points;
  }
  double score(double expected_per_cell) const {
    int good = 0, counted = 0;
    for (int row = 0; row < rows_; ++row) {
      const std::vector<int> hits = hits_inside(row);
      for (int column = 0; column < columns_; ++column) {
        const auto at = static_cast<std::size_t>(row * columns_ + column);
        const double share = hits[static_cast<std::size_t>(column)] / static_cast<double>(fine * fine);
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
  static constexpr int fine = 6;  // samples of a cell's area along each side

  // Written so that NaN is `most_each_side` too.
  int count(double reach) const {
    const double cells = std::ceil(reach / side_);
    return 2 * static_cast<int>(cells < most_each_side ? cells : most_each_side);
  }
  int cell(double u, int cells) const {  // -1 where there is none
    const double at = u * inverse_ + cells / 2;
    return at >= 0.0 && at < cells ? static_cast<int>(at) : -1;
  }
  // Of a row's cells, how many of their samples lie inside: line by line, each an interval.
  std::vector<int> hits_inside(int row) const {
    std::vector<int> hits(static_cast<std::size_t>(columns_));
    const double last = fine * columns_ - 1;
    for (int i = 0; i < fine; ++i) {
      const auto [from, to] = bound_.across(side_ * (row - rows_ / 2 + (i + 0.5) / fine));
      const auto place = [&](double x) { return fine * (x * inverse_ + columns_ / 2) - 0.5; };
      const double first_hit = std::max(std::ceil(place(from)), 0.0),
                   last_hit = std::min(std::floor(place(to)), last);
      if (!(from <= to) || !(first_hit <= last_hit)) continue;
      const int begin = static_cast<int>(first_hit), end = static_cast<int>(last_hit) + 1;
      for (int column = begin / fine; column * fine < end; ++column) {
        hits[static_cast<std::size_t>(column)] +=
            std::min(end, fine * (column + 1)) - std::max(begin, fine * column);
      }
    }
    return hits;
  }

  InsideOutline bound_, doubtless_;  // outside the latter is outside beyond the outline's own doubt
  double side_, inverse_;            // m, 1/m
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

}  // namespace

double coverage(const Patch& patch, const std::vector<Vector2d>& feet_patch,
                const std::vector<double>& weights) {
  constexpr double points_per_cell = 12.0, most_cells = 50.0;
  const Boundary bound = boundary(patch);
  const auto used = static_cast<double>(std::ranges::count_if(weights, [](double w) { return w > 0.0; }));
  const double cells = std::clamp(used / points_per_cell, 4.0, most_cells);
  const double side = std::sqrt(area(bound) / cells);
  if (!(side > 0.0 && std::isfinite(side))) return 0.0;
  Vector2d reach = extent(bound);
  for (std::size_t i = 0; i < feet_patch.size(); ++i) {
    if (weights[i] > 0.0) reach = reach.cwiseMax(feet_patch[i].cwiseAbs());
  }
  reach = reach.cwiseMin(3.0 * extent(bound));
  CellGrid grid(bound, beyond_doubt(patch), side, reach);
  for (std::size_t i = 0; i < feet_patch.size(); ++i) {
    if (weights[i] > 0.0) grid.add(feet_patch[i], used * weights[i]);
  }
  return grid.score(used / cells);
}

}  // namespace patchlab
