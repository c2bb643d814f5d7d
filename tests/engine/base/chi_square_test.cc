#include "engine/base/chi_square.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

namespace patchlab::test {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;

double exact_log_normal_cdf(double x) {
  return static_cast<double>(log(boost::math::erfc(-Exact(x) / sqrt(Exact(2))) / 2));
}

TEST(ChiSquare, QuantilesAreThoseOfThePrintedTables) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1), 3.841458820694124, 1e-12);
  EXPECT_NEAR(chi_square_quantile(0.95, 3), 7.814727903251179, 1e-12);
  EXPECT_NEAR(chi_square_quantile(0.99, 10), 23.209251158954356, 1e-11);
  EXPECT_EQ(chi_square_quantile(0.0, 3), 0.0);
}

TEST(ChiSquare, TwoDegreesOfFreedomAreExponential) {
  for (const double x : {0.0, 0.1, 2.0, 20.0}) {
    EXPECT_NEAR(chi_square_cdf(x, 2), 1.0 - std::exp(-0.5 * x), 1e-15);
    EXPECT_NEAR(chi_square_p_value(x, 2), std::exp(-0.5 * x), 1e-15);
  }
}

TEST(ChiSquare, PValueIsAccurateInTheFarTail) {
  EXPECT_NEAR(chi_square_p_value(600.0, 2) / std::exp(-300.0), 1.0, 1e-12);
  EXPECT_GT(chi_square_p_value(1200.0, 300), 0.0);
}

TEST(ChiSquare, QuantileUndoesTheCdf) {
  for (const double dof : {1.0, 3.0, 146.0, 1e4}) {
    EXPECT_NEAR(chi_square_cdf(chi_square_quantile(0.3, dof), dof), 0.3, 1e-12);
  }
}

TEST(ChiSquare, EllipsoidScales) {
  EXPECT_NEAR(ellipsoid_scale(0.95, 3), 2.7954834829151074, 1e-12);
  EXPECT_NEAR(ellipsoid_scale(0.95, 2), std::sqrt(-2.0 * std::log(0.05)), 1e-12);
  EXPECT_NEAR(ellipsoid_scale(0.95, 1), two_sided_normal_quantile(0.95), 1e-12);
}

TEST(NormalDistribution, TwoSidedQuantile) {
  EXPECT_NEAR(two_sided_normal_quantile(0.95), 1.959963984540054, 1e-12);
  EXPECT_NEAR(two_sided_normal_quantile(0.6826894921370859), 1.0, 1e-12);
  EXPECT_EQ(two_sided_normal_quantile(0.0), 0.0);
}

TEST(NormalDistribution, LogCdfIsExactDownIntoTheTail) {
  for (const double x : {8.0, 3.0, 0.0, -1.0, -5.0, -20.0, -29.9, -30.1, -35.0, -100.0}) {
    EXPECT_NEAR(log_normal_cdf(x) / exact_log_normal_cdf(x), 1.0, 1e-9) << x;
  }
}

TEST(NormalDistribution, LogCdfIsFiniteAndIncreasingEverywhere) {
  double before = log_normal_cdf(-1e6);
  EXPECT_TRUE(std::isfinite(before));
  for (double x = -40.0; x < 5.0; x += 0.125) {
    const double now = log_normal_cdf(x);
    EXPECT_GT(now, before) << x;
    before = now;
  }
}

// Residuals of no size under a noise model of thousands of points, and the other way round.
TEST(ChiSquare, TailsBeyondAllNumbersAreNoneOrAll) {
  for (const double dof : {1.0, 100.0, 3807.0, 1e6})
    for (const double share : {0.0, 1e-300, 1e-9, 0.01, 0.049, 0.051, 1.0, 1e3, 1e9, 1e300}) {
      const double p = chi_square_p_value(share * dof, dof);
      EXPECT_TRUE(p >= 0.0 && p <= 1.0) << share << " " << dof << " " << p;
      EXPECT_NEAR(chi_square_cdf(share * dof, dof), 1.0 - p, 1e-12) << share << " " << dof;
    }
  EXPECT_EQ(chi_square_p_value(std::numeric_limits<double>::infinity(), 5.0), 0.0);
}

}  // namespace
}  // namespace patchlab::test
