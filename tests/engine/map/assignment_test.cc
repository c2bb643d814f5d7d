#include "engine/map/assignment.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

double total(const Eigen::MatrixXd& cost, const std::vector<int>& column_of, double alone) {
  double sum = 0.0;
  for (std::size_t i = 0; i < column_of.size(); ++i) {
    sum += column_of[i] < 0 ? alone : cost(static_cast<Eigen::Index>(i), column_of[i]);
  }
  return sum;
}

// The least total cost by trying everything.
double least_total(const Eigen::MatrixXd& cost, double alone, Eigen::Index row, std::vector<bool>& taken) {
  if (row == cost.rows()) return 0.0;
  double least = alone + least_total(cost, alone, row + 1, taken);
  for (Eigen::Index j = 0; j < cost.cols(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    if (taken[at]) continue;
    taken[at] = true;
    least = std::min(least, cost(row, j) + least_total(cost, alone, row + 1, taken));
    taken[at] = false;
  }
  return least;
}

TEST(Assignment, CostsAsLittleAsTryingEverything) {
  test::SeededRandom random;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd cost(1 + static_cast<Eigen::Index>(random.index(5)),
                         1 + static_cast<Eigen::Index>(random.index(5)));
    for (double& entry : cost.reshaped()) {
      entry = random.uniform() < 0.3 ? std::numeric_limits<double>::infinity() : random.uniform(0.0, 2.0);
    }
    const std::vector<int> column_of = assign(cost, 1.0);
    std::vector<bool> taken(static_cast<std::size_t>(cost.cols()), false);
    EXPECT_NEAR(total(cost, column_of, 1.0), least_total(cost, 1.0, 0, taken), 1e-9);
    for (const int j : column_of) {
      if (j < 0) continue;
      EXPECT_EQ(std::ranges::count(column_of, j), 1);
    }
  }
}

TEST(Assignment, OfNothingIsNothing) {
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3), 1.0).empty());
  EXPECT_EQ(assign(Eigen::MatrixXd(2, 0), 1.0), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace patchlab
