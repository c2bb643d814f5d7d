#include "engine/region/polygon_mask.h"

#include <algorithm>
#include <cmath>

namespace patchlab {
namespace {

constexpr double kMostCells = 2048;             // a side
constexpr std::size_t kMostRowEdges = 1 << 20;  // in all rows together
constexpr double kLargestCoordinate = 1 << 24;  // px: up to here rounding is small against the margin

// Sets the cells [first, last) of a row, which are outside yet.
void paint(std::uint32_t* row, std::ptrdiff_t first, std::ptrdiff_t last, PolygonMask::Cell cell) {
  constexpr std::ptrdiff_t n = PolygonMask::cells_a_word;
  if (first >= last) return;
  const std::uint32_t all = 0x55555555U * cell;
  const std::uint32_t from = all << 2 * (first % n), to = all >> 2 * (n - 1 - (last - 1) % n);
  std::uint32_t *const begin = row + first / n, *const end = row + (last - 1) / n;
  if (begin == end) {
    *begin |= from & to;
    return;
  }
  *begin |= from;
  std::fill(begin + 1, end, all);
  *end |= to;
}

}  // namespace

std::vector<PolygonEdge> polygon_edges(const std::vector<Eigen::Vector2d>& contour) {
  std::vector<PolygonEdge> edges;
  edges.reserve(contour.size());
  for (std::size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++) {
    edges.push_back({contour[i].x(), contour[i].y(), contour[j].x(), contour[j].y()});
  }
  return edges;
}

bool inside_polygon(std::span<const PolygonEdge> edges, double x, double y) {
  bool odd = false;
  for (const PolygonEdge& edge : edges) odd ^= edge.crosses(x, y);
  return odd;
}

PolygonMask::PolygonMask(const std::vector<Eigen::Vector2d>& contour) : edges_(polygon_edges(contour)) {
  if (!choose_grid()) return;
  bucket_edges();
  paint_rows();
}

bool PolygonMask::contains(double x, double y) const {
  if (rows_ == 0) return inside_polygon(edges_, x, y);
  const double column = (x - low_.x()) * cells_a_pixel_;
  const double row = (y - low_.y()) * cells_a_pixel_;
  const bool on_grid = column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns_) &&
                       row < static_cast<double>(rows_);
  if (!on_grid) return false;
  const auto r = static_cast<std::ptrdiff_t>(row);
  const Cell cell = grid().cell(static_cast<std::ptrdiff_t>(column), r);
  return cell == on_edge ? inside_polygon(edges_of(r), x, y) : cell == inside;
}

// The smallest cell from 1 px on that keeps the grid and its row lists small; false where there is no
// polygon, or it is not finite or far out.
bool PolygonMask::choose_grid() {
  if (edges_.size() < 3) return false;
  low_ = {edges_.front().ax, edges_.front().ay};
  Eigen::Vector2d high = low_;
  double heights = 0.0;
  for (const PolygonEdge& edge : edges_) {
    const Eigen::Vector2d vertex(edge.ax, edge.ay);
    if (!(vertex.array().abs() <= kLargestCoordinate).all()) return false;
    low_ = low_.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
    heights += std::abs(edge.ay - edge.by);
  }
  const double widest = (high - low_).maxCoeff();
  const double most_heights = static_cast<double>(std::max(kMostRowEdges, 2 * edges_.size()));
  while (widest / cell_ > kMostCells || heights / cell_ > most_heights) cell_ *= 2.0;
  cells_a_pixel_ = 1.0 / cell_;
  low_ = (low_.array() - cell_).floor();
  columns_ = static_cast<std::ptrdiff_t>((high - low_).x() * cells_a_pixel_) + 2;
  rows_ = static_cast<std::ptrdiff_t>((high - low_).y() * cells_a_pixel_) + 2;
  return true;
}

PolygonMask::Span PolygonMask::cells_between(double v0, double v1, double origin,
                                             std::ptrdiff_t count) const {
  const auto index = [&](double value) {
    return std::clamp(static_cast<std::ptrdiff_t>((value - origin) * cells_a_pixel_), std::ptrdiff_t{0},
                      count - 1);
  };
  return {index(std::min(v0, v1) - margin * cell_), index(std::max(v0, v1) + margin * cell_)};
}

PolygonMask::Span PolygonMask::rows_of(const PolygonEdge& edge) const {
  return cells_between(edge.ay, edge.by, low_.y(), rows_);
}

// An edge touches the columns between its crossings with the lower and the upper side of the row.
PolygonMask::Span PolygonMask::columns_of(const PolygonEdge& edge, std::ptrdiff_t row) const {
  const double rise = edge.by - edge.ay;
  if (rise == 0.0) return cells_between(edge.ax, edge.bx, low_.x(), columns_);
  const auto x_at = [&](double row_side) {
    const double y = low_.y() + row_side * cell_;
    return edge.ax + (edge.bx - edge.ax) * std::clamp((y - edge.ay) / rise, 0.0, 1.0);
  };
  const auto side = static_cast<double>(row);
  return cells_between(x_at(side - margin), x_at(side + 1.0 + margin), low_.x(), columns_);
}

void PolygonMask::bucket_edges() {
  row_start_.assign(static_cast<std::size_t>(rows_) + 1, 0);
  for (const PolygonEdge& edge : edges_) {
    const Span rows = rows_of(edge);
    for (auto r = rows.first; r <= rows.last; ++r) ++row_start_[static_cast<std::size_t>(r) + 1];
  }
  for (std::size_t r = 1; r < row_start_.size(); ++r) row_start_[r] += row_start_[r - 1];
  row_edges_.resize(row_start_.back());
  std::vector<std::size_t> next(row_start_);
  for (const PolygonEdge& edge : edges_) {
    const Span rows = rows_of(edge);
    for (auto r = rows.first; r <= rows.last; ++r) row_edges_[next[static_cast<std::size_t>(r)]++] = edge;
  }
}

void PolygonMask::paint_rows() {
  words_a_row_ = columns_ / cells_a_word + 1;
  words_.assign(static_cast<std::size_t>(words_a_row_ * (rows_ + 1) + 1), outside);
  words_.back() = on_edge;
  std::vector<Span> edge_cells;
  for (std::ptrdiff_t r = 0; r < rows_; ++r) {
    edge_cells.clear();
    for (const PolygonEdge& edge : edges_of(r)) edge_cells.push_back(columns_of(edge, r));
    std::ranges::sort(edge_cells, {}, &Span::first);
    paint_row(r, edge_cells);
  }
}

// No edge touches the cells between two edge cells of a row: one test decides them all.
void PolygonMask::paint_row(std::ptrdiff_t row, std::span<const Span> edge_cells) {
  std::uint32_t* const words = words_.data() + row * words_a_row_;
  const double y = low_.y() + (static_cast<double>(row) + 0.5) * cell_;
  std::ptrdiff_t next = edge_cells.empty() ? 0 : edge_cells.front().first;
  for (const Span& span : edge_cells) {
    const double x = low_.x() + (static_cast<double>(next) + 0.5) * cell_;
    if (next < span.first && inside_polygon(edges_of(row), x, y)) paint(words, next, span.first, inside);
    paint(words, std::max(next, span.first), span.last + 1, on_edge);
    next = std::max(next, span.last + 1);
  }
}

std::span<const PolygonEdge> PolygonMask::edges_of(std::ptrdiff_t row) const {
  const std::size_t first = row_start_[static_cast<std::size_t>(row)];
  return {row_edges_.data() + first, row_start_[static_cast<std::size_t>(row) + 1] - first};
}

}  // namespace patchlab
