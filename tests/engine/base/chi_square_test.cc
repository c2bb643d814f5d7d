#include "engine/base/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlab {
namespace {

TEST(ChiSquare, QuantilesAreThoseOfTheTables) {
  const double table_95[] = {3.8415,  5.9915,  7.8147,  9.4877,  11.0705, 12.5916,
                             14.0671, 15.5073, 16.9190, 18.3070, 19.6751};
  double dof = 0.0;
  for (const double expected : table_95)
    EXPECT_NEAR(chi_square_quantile(0.95, dof += 1.0), expected, 5e-5) << dof;
}

TEST(ChiSquare, CdfAndTailAndQuantileFitTogether) {
  for (const double x : {0.5, 3.0, 40.0}) {
    EXPECT_NEAR(chi_square_cdf(x, 5.0) + chi_square_p_value(x, 5.0), 1.0, 1e-14);
    EXPECT_NEAR(chi_square_quantile(chi_square_cdf(x, 5.0), 5.0), x, 1e-6 * x);
  }
  EXPECT_NEAR(chi_square_p_value(200.0, 2.0) / std::exp(-100.0), 1.0, 1e-10)
      << "the tail is exact where it is tiny";
}

TEST(ChiSquare, EllipsoidsAndIntervalsHaveTheUsualScales) {
  EXPECT_NEAR(ellipsoid_scale(0.95, 3), 2.7955, 5e-5);
  EXPECT_NEAR(ellipsoid_scale(0.95, 1), two_sided_normal_quantile(0.95), 1e-12);
  EXPECT_NEAR(two_sided_normal_quantile(0.95), 1.959964, 5e-7);
}

TEST(LogNormalCdf, IsFiniteAndSmoothFarInTheTail) {
  EXPECT_NEAR(log_normal_cdf(0.0), std::log(0.5), 1e-15);
  EXPECT_NEAR(log_normal_cdf(-10.0), -53.23128515051247, 1e-12);
  EXPECT_NEAR(log_normal_cdf(-30.0 + 1e-9), log_normal_cdf(-30.0 - 1e-9), 1e-6)
      << "where the series takes over";
  EXPECT_NEAR(log_normal_cdf(-1e5), -5.0e9 - std::log(1e5) - 0.918938533204673, 1e-5);
}

}  // namespace
}  // namespace patchlab
