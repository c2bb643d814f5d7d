#include "engine/io/covariance_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(CovarianceColumns, RoundingIsClampedAndWhatIsBadIsCounted) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Covariance6> covariances = {
      {1e-6, 0, 0, 2e-6, 0, 3e-6},             // good
      {1e-6, 1e-6, 0, 1e-6, 0, 0},             // of rank one
      {1e-6, 1e-6 + 1e-13, 0, 1e-6, 0, 1e-6},  // an eigenvalue of -1e-13
      {1e-6, 2e-6, 0, 1e-6, 0, 1e-6},          // one of -1e-6
      {nan, 0, 0, 1e-6, 0, 1e-6},
      {-1e-6, 0, 0, -1e-6, 0, -1e-6},
      {0, 0, 0, 0, 0, 0},
      {nan, nan, nan, nan, nan, nan},  // of a point that is none
  };
  const std::vector<Covariance6> before = covariances;
  const CovarianceCount count = judge_covariances(covariances, {1, 1, 1, 1, 1, 1, 1, 0});
  EXPECT_EQ(count.clamped, 1u);
  EXPECT_EQ(count.bad, 3u);
  EXPECT_EQ(covariances[0], before[0]);
  EXPECT_EQ(covariances[1], before[1]);
  EXPECT_EQ(covariances[3], before[3]) << "what is bad is left for the fit to refuse";
  EXPECT_LE(covariances[2][1], covariances[2][0]);
  EXPECT_NEAR(covariances[2][1], 1e-6, 1e-12);
}

TEST(CovarianceColumns, BadOnesAreNoted) {
  const Result<Scan> scan =
      read_scan_bytes("x,y,z,cxx,cxy,cxz,cyy,cyz,czz\n1,2,3,1,2,0,1,0,1\n1,2,4,1,0,0,1,0,1\n", "a");
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_THAT(scan->notices, Contains(HasSubstr("not finite: 1; a fit that uses one of them is refused")));
}

TEST(CovarianceColumns, DeviationsBelowZeroAreBad) {
  for (const char* text : {"x,y,z,sigma\n1,2,3,0.1\n4,5,6,-0.1\n",
                           "x,y,z,sigma_range,sigma_lateral\n1,2,3,0.1,0.1\n4,5,6,0.1,-0.1\n"}) {
    const Result<Scan> scan = read_scan_bytes(text, "a");
    ASSERT_TRUE(scan) << scan.error().message;
    EXPECT_THAT(scan->notices, Contains(HasSubstr("not finite: 1; a fit that uses one of them is refused")));
  }
}

TEST(CovarianceColumns, DeviationsInMillimetresBecomeMetres) {
  ReadOptions options;
  options.unit = LengthUnit::mm;
  const Result<Scan> scan = read_scan_bytes("x,y,z,sigma\n1,2,3,2\n", "a", options);
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_NEAR(scan->covariances[0][0], 4e-6, 1e-18);
}

}  // namespace
}  // namespace patchlab
