#include "engine/base/random.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

TEST(Random, TheSameSeedGivesTheSameNumbers) {
  Random a(7), b(7);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(a.uniform(), b.uniform());
    EXPECT_EQ(a.normal(), b.normal());
    EXPECT_EQ(a.index(1000), b.index(1000));
  }
}

TEST(Random, OtherSeedsGiveOtherNumbers) {
  Random a(7), b(8);
  EXPECT_NE(a.uniform(), b.uniform());
}

TEST(Random, UniformNumbersStayInTheirRangeAndFillIt) {
  SeededRandom random;
  double sum = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const double x = random.uniform(-2.0, 4.0);
    ASSERT_GE(x, -2.0);
    ASSERT_LT(x, 4.0);
    sum += x;
  }
  EXPECT_NEAR(sum / 10000, 1.0, 5.0 * 6.0 / std::sqrt(12.0 * 10000));
}

TEST(Random, NormalNumbersHaveMeanZeroAndVarianceOne) {
  SeededRandom random;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / 10000, 0.0, 5.0 / std::sqrt(10000.0));
  EXPECT_NEAR(squares / 10000, 1.0, 5.0 * std::sqrt(2.0 / 10000));
}

TEST(Random, IndicesReachBothEnds) {
  SeededRandom random;
  std::set<std::size_t> seen;
  for (int i = 0; i < 200; ++i) seen.insert(random.index(5));
  EXPECT_EQ(seen, (std::set<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(random.index(1), 0u);
}

TEST(Random, DirectionsAreUnitAndUniform) {
  SeededRandom random;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d n = random.unit3();
    ASSERT_NEAR(n.norm(), 1.0, 1e-15);
    sum += n * n.transpose();
  }
  EXPECT_LT((sum / 10000 - Eigen::Matrix3d::Identity() / 3.0).cwiseAbs().maxCoeff(), 0.02);
}

TEST(SeededRandom, SeedFollowsFromTheName) {
  EXPECT_EQ(current_test_name(), "SeededRandom.SeedFollowsFromTheName");
  EXPECT_EQ(seed_of(""), 14695981039346656037u);
  EXPECT_NE(seed_of("a"), seed_of("b"));
}

}  // namespace
}  // namespace patchlab::test
