// A polygon in pixels as a grid of cells that lie wholly inside, wholly outside or on an edge: most points
// are decided by a look at their cell, those of edge cells by the exact test against the edges of their row
// alone.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlab {

struct PolygonEdge {
  double ax, ay, bx, by;

  // True where it crosses the horizontal through y to the right of x; half open in y, so that a vertex counts
  // once.
  bool crosses(double x, double y) const {
    return (ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax;
  }
};

std::vector<PolygonEdge> polygon_edges(const std::vector<Eigen::Vector2d>& contour);
// The even-odd rule.
bool inside_polygon(std::span<const PolygonEdge> edges, double x, double y);

class PolygonMask {
 public:
  enum Cell : std::uint8_t { outside, inside, on_edge };
  static constexpr std::ptrdiff_t cells_a_word = 16;
  // No edge is within this of a cell that is not on_edge, in cells: far more than the rounding of a crossing.
  static constexpr double margin = 1.0 / 16.0;

  explicit PolygonMask(const std::vector<Eigen::Vector2d>& contour);

  // Exactly inside_polygon(contour, x, y) of engine/region/lasso.h, for any x and y.
  bool contains(double x, double y) const;

  // For who looks many cells up. The polygon stays a cell away from the grid's border.
  struct Grid {
    Eigen::Vector2d low;           // its corner, px
    double cells_a_pixel;          // a power of two
    std::ptrdiff_t columns, rows;  // 0: no grid, every point needs contains()
    const std::uint32_t* words;  // row by row, 16 cells each, the first in the two lowest bits; a column and
                                 // a row more than those above are there to be read, and outside
    std::ptrdiff_t words_a_row;

    // One on_edge, after all others: stands for no place. Cells count row by row, cells_a_word each word.
    std::ptrdiff_t unsure_cell() const { return cells_a_word * words_a_row * (rows + 1); }

    Cell cell(std::ptrdiff_t column, std::ptrdiff_t row) const {
      const std::uint32_t word = words[row * words_a_row + column / cells_a_word];
      return static_cast<Cell>(word >> 2 * (column % cells_a_word) & 3U);
    }
  };
  Grid grid() const { return {low_, cells_a_pixel_, columns_, rows_, words_.data(), words_a_row_}; }

 private:
  struct Span {
    std::ptrdiff_t first, last;  // inclusive
  };

  bool choose_grid();
  void bucket_edges();
  void paint_rows();
  void paint_row(std::ptrdiff_t row, std::span<const Span> edge_cells);
  Span cells_between(double v0, double v1, double origin, std::ptrdiff_t count) const;
  Span rows_of(const PolygonEdge& edge) const;
  Span columns_of(const PolygonEdge& edge, std::ptrdiff_t row) const;
  std::span<const PolygonEdge> edges_of(std::ptrdiff_t row) const;

  std::vector<PolygonEdge> edges_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();  // corner of the grid, px
  double cell_ = 1.0;                              // side of a cell, px: a power of two
  double cells_a_pixel_ = 1.0;                     // 1 / cell_, exact
  std::ptrdiff_t columns_ = 0, rows_ = 0;          // 0: no grid, every point gets the exact test
  std::ptrdiff_t words_a_row_ = 0;                 // these as Grid has them
  std::vector<std::uint32_t> words_;
  std::vector<PolygonEdge> row_edges_;  // those of row r: from row_start_[r] to row_start_[r + 1]
  std::vector<std::size_t> row_start_;
};

}  // namespace patchlab
