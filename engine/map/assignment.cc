#include "engine/map/assignment.h"

#include <cmath>
#include <limits>

namespace patchlab {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Potentials u of rows and v of columns with cost - u - v >= 0, zero on chosen pairs. Index 0 is none.
class Matching {
 public:
  explicit Matching(const Eigen::MatrixXd& cost)
      : cost_(cost), u_(size(cost.rows()), 0.0), v_(size(cost.cols()), 0.0), row_of_(size(cost.cols()), 0) {}

  // Gives `row` a column, along the shortest path of changes.
  void add(std::size_t row) {
    std::vector<double> least(v_.size(), infinite);
    std::vector<std::size_t> before(v_.size(), 0);
    std::vector<bool> done(v_.size(), false);
    row_of_[0] = row;
    std::size_t at = 0;
    while (row_of_[at] != 0) at = step(at, least, before, done);
    for (; at != 0; at = before[at]) row_of_[at] = row_of_[before[at]];
  }

  std::size_t row_of(std::size_t column) const { return row_of_[column]; }

 private:
  static std::size_t size(Eigen::Index n) { return static_cast<std::size_t>(n) + 1; }
  double reduced(std::size_t row, std::size_t column) const {
    return cost_(static_cast<Eigen::Index>(row) - 1, static_cast<Eigen::Index>(column) - 1) - u_[row] -
           v_[column];
  }

  // The nearest column that is not done yet.
  std::size_t step(std::size_t at, std::vector<double>& least, std::vector<std::size_t>& before,
                   std::vector<bool>& done) {
    done[at] = true;
    double delta = infinite;
    std::size_t next = 0;
    for (std::size_t j = 1; j < v_.size(); ++j) {
      if (done[j]) continue;
      const double there = reduced(row_of_[at], j);
      if (there < least[j]) {
        least[j] = there;
        before[j] = at;
      }
      if (least[j] < delta) {
        delta = least[j];
        next = j;
      }
    }
    for (std::size_t j = 0; j < v_.size(); ++j) {
      if (done[j]) {
        u_[row_of_[j]] += delta;
        v_[j] -= delta;
      } else {
        least[j] -= delta;
      }
    }
    return next;
  }

  const Eigen::MatrixXd& cost_;
  std::vector<double> u_, v_;
  std::vector<std::size_t> row_of_;
};

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& cost, double alone) {
  const Eigen::Index rows = cost.rows(), columns = cost.cols();
  Eigen::MatrixXd padded = Eigen::MatrixXd::Constant(rows, columns + rows, alone);
  constexpr double never = 1e12;  // finite, so that potentials stay numbers
  padded.leftCols(columns) = cost.unaryExpr([](double c) { return std::isfinite(c) ? c : never; });
  Matching matching(padded);
  for (Eigen::Index i = 0; i < rows; ++i) matching.add(static_cast<std::size_t>(i) + 1);
  std::vector<int> column_of(static_cast<std::size_t>(rows), -1);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const std::size_t row = matching.row_of(static_cast<std::size_t>(j) + 1);
    if (row != 0) column_of[row - 1] = static_cast<int>(j);
  }
  return column_of;
}

}  // namespace patchlab
