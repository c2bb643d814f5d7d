#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Scan read(const std::string& text) {
  Result<Scan> scan = read_point_table(text, "points.csv");
  if (!scan) ADD_FAILURE() << scan.error().message;
  return scan ? *std::move(scan) : Scan{};
}

std::string refusal(const std::string& text) {
  const Result<Scan> scan = read_point_table(text, "points.csv");
  if (scan) return "accepted";
  EXPECT_EQ(scan.error().code, ErrorCode::unreadable);
  EXPECT_THAT(scan.error().message, testing::StartsWith("points.csv: "));
  return scan.error().message;
}

TEST(PointTable, CommasSemicolonsTabsAndSpacesSeparate) {
  for (const char* text :
       {"x,y,z\n1,2,3\n4,5,6\n", "x;y;z\r\n1;2;3\r\n4;5;6\r\n", "x\ty\tz\n1\t2\t3\n4\t5\t6",
        "x y  z\n 1 2 3\n4  5\t6\n", " x , y , z\n1 , 2 ,3\n\n4, 5 ,6 \n\n",
        "# made by hand\n\"x\",\"y\",\"z\"\n1,2,3\n4,5,6\n"}) {
    const Scan scan = read(text);
    ASSERT_EQ(scan.size(), 2U) << text;
    EXPECT_EQ(scan.point(0), Eigen::Vector3d(1, 2, 3)) << text;
    EXPECT_EQ(scan.point(1), Eigen::Vector3d(4, 5, 6)) << text;
  }
}

TEST(PointTable, SensorIsAtTheOriginLookingForwardAndNobodySaidSo) {
  const Scan scan = read("x,y,z\n1,2,3\n");
  EXPECT_FALSE(scan.viewpoint.stated);
  EXPECT_EQ(rotation(scan.viewpoint), Eigen::Matrix3d::Identity());
  EXPECT_THAT(scan.notices, Contains(HasSubstr("looking along +z")));
  EXPECT_FALSE(scan.organized());
  EXPECT_EQ(scan.width, 1U);
}

TEST(PointTable, SensorsOfPointsAreKeptAndNothingIsAssumedBeside) {
  const Scan scan = read("x,y,z,vp_x,vp_y,vp_z\n1,2,3,0,0,1\n4,5,6,1,0,1\n");
  ASSERT_EQ(scan.viewpoints.size(), 2U);
  EXPECT_EQ(scan.origin + scan.viewpoints[1].cast<double>(), Eigen::Vector3d(1, 0, 1));
  EXPECT_THAT(scan.notices, Not(Contains(HasSubstr("at the origin"))));
  EXPECT_THAT(read("x,y,z,vp_x,vp_y,vp_z\n1,2,3,0,nan,1\n4,5,6,1,0,1\n").notices,
              Contains(HasSubstr(
                  "sensor position is not finite are taken as seen from the viewpoint of the scan: 1")));
  EXPECT_THAT(refusal("x,y,z,vp_x,vp_z\n1,2,3,0,0\n"), HasSubstr("'vp_y' is missing"));
}

TEST(PointTable, CovariancesKeepAllTheirDigits) {
  const Scan scan = read(
      "x,y,z,cxx,cxy,cxz,cyy,cyz,czz\n0,0,1,5.665926905e-07,1.266109643e-07,-1.460895742e-06,6.09e-07,-1.7e-06,1.99e-05\n");
  EXPECT_THAT(scan.covariances, ElementsAre(Covariance6{5.665926905e-07, 1.266109643e-07, -1.460895742e-06,
                                                        6.09e-07, -1.7e-06, 1.99e-05}));
}

TEST(PointTable, CoordinatesLoseNoMoreThanTheirExtentAllows) {
  const Scan scan =
      read("x,y,z\n-0.075296602,-0.088411819,1.019688455\n-0.078688533,-0.083131184,1.008427772\n");
  EXPECT_LT((scan.point(0) - Eigen::Vector3d(-0.075296602, -0.088411819, 1.019688455)).norm(), 2e-9);
}

TEST(PointTable, ColumnsInAnyOrderAndColumnsWithoutMeaningAreLeftOut) {
  const Scan scan = read("name,z,label,y,x\nmug,3,7,2,1\ncup,6,8,5,4\n");
  EXPECT_EQ(scan.point(1), Eigen::Vector3d(4, 5, 6));
  EXPECT_THAT(scan.labels, ElementsAre(7U, 8U));
  EXPECT_THAT(scan.notices, Contains(HasSubstr("left out: name")));
  EXPECT_EQ(scan.fields.size(), 4U);
}

TEST(PointTable, LinesAtFaultAreNamed) {
  EXPECT_THAT(refusal("x,y,z\n1,2,3\n1,two,3\n"), HasSubstr("line 3: 'two' in column 'y'"));
  EXPECT_THAT(refusal("x,y,z\n1,2\n"), HasSubstr("line 2: has 2 columns where the header row has 3"));
  EXPECT_THAT(refusal("x,y,z\n1,2,3,4\n"), HasSubstr("has 4 columns"));
  EXPECT_THAT(refusal("x,y,z\n1,,3\n"), HasSubstr("'' in column 'y'"));
  EXPECT_THAT(refusal("x;y;z\n0,1;0,2;0,3\n"), HasSubstr("with a point"));
  EXPECT_THAT(refusal("x,y,z\n1,2,0x10\n"), HasSubstr("'0x10'"));
}

TEST(PointTable, HeaderRowsWithoutSenseAreRefused) {
  EXPECT_THAT(refusal("1,2\n"), HasSubstr("line 1: is neither a header row"));
  EXPECT_THAT(refusal("x,y\n1,2\n"), HasSubstr("header row"));
  EXPECT_THAT(refusal("x,y,z,x\n1,2,3,4\n"), HasSubstr("'x' twice"));
  EXPECT_THAT(refusal("x,y,z,cxx\n1,2,3,4\n"), HasSubstr("'cxy' is missing"));
  EXPECT_THAT(refusal("x,y,z\n"), HasSubstr("no points"));
  EXPECT_THAT(refusal("\n#\n"), HasSubstr("no rows of numbers"));
}

TEST(PointTable, RowsWithoutAHeaderBeginWithXYZ) {
  for (const char* text :
       {"1,2,3,9\n4,5,6,9\n", "1 2 3 9\r\n4 5 6 9\r\n", "1;2;3;9\n\n4;5;6;9\n", "1\t2\t3\t9\n4\t5\t6\t9\n",
        "# made by hand\n1 2 3 9\n// more\n  4   5 6 9\n", "1 2 3 9 \n4 5 6 9\n"}) {
    const Scan scan = read(text);
    ASSERT_EQ(scan.size(), 2U) << text;
    EXPECT_EQ(scan.point(1), Eigen::Vector3d(4, 5, 6)) << text;
    EXPECT_THAT(scan.notices, Contains(HasSubstr("no header row: its first three columns")));
    EXPECT_THAT(scan.notices, Contains(HasSubstr("the columns after them were left out")));
  }
  EXPECT_THAT(refusal("1 2 3\n4 5 6 7\n"), HasSubstr("line 2: has 4 columns where the first row has 3"));
}

TEST(PointTable, ALineMaySayHowManyRowsFollow) {
  EXPECT_EQ(read("2\n1 2 3 -100 255 0 0\n4 5 6 -100 255 0 0\n").size(), 2U);
  EXPECT_THAT(refusal("3\n1 2 3 -100 255 0 0\n4 5 6 -100 255 0 0\n"),
              HasSubstr("promises 3 points, but 2 follow"));
  EXPECT_THAT(refusal("2\n1\n0 0 0\n1 0 0\n"), HasSubstr("line 2: is neither a header row"));
}

TEST(PointTable, HeaderRowsMayStandInACommentAndInCapitals) {
  for (const char* text : {"//X Y Z R\n1 2 3 9\n", "# x y z r\n1 2 3 9\n", "X,Y,Z,Intensity\n1,2,3,9\n"}) {
    const Scan scan = read(text);
    ASSERT_EQ(scan.size(), 1U) << text;
    EXPECT_EQ(scan.point(0), Eigen::Vector3d(1, 2, 3)) << text;
    EXPECT_THAT(scan.notices, Not(Contains(HasSubstr("no header row"))));
  }
}

TEST(PointTable, PointsThatAreNoneAreKeptAndCountedOut) {
  const Scan scan = read("x,y,z\nnan,nan,nan\n1,2,3\n");
  EXPECT_EQ(scan.size(), 2U);
  EXPECT_EQ(scan.finite_count, 1U);
  EXPECT_THAT(scan.notices, Not(Contains(HasSubstr("None"))));
}

}  // namespace
}  // namespace patchlab
