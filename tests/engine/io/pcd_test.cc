// The PCD reader on small files written here, a rule each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Parts of a header that tests change; an empty line is left out.
struct Header {
  std::string version = "VERSION 0.7\n";
  std::string fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  std::string grid = "WIDTH 2\nHEIGHT 1\n";
  std::string viewpoint = "VIEWPOINT 0 0 0 1 0 0 0\n";
  std::string points = "POINTS 2\n";

  std::string with(const std::string& data) const {
    return "# .PCD v0.7 - Point Cloud Data file format\n" + version + fields + grid + viewpoint + points +
           data;
  }
};

const std::string two_points = "DATA ascii\n1 2 3\n4 5 6\n";

template <class... Values>
std::string bytes(Values... values) {
  std::string text;
  (text.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return text;
}

Scan read(const std::string& file, const ReadOptions& options = {}) {
  Result<Scan> scan = read_pcd(file, "scan.pcd", options);
  if (!scan) ADD_FAILURE() << scan.error().message;
  return scan ? *std::move(scan) : Scan{};
}

std::string refusal(const std::string& file, const ReadOptions& options = {}) {
  const Result<Scan> scan = read_pcd(file, "scan.pcd", options);
  if (scan) return "accepted";
  EXPECT_EQ(scan.error().code, ErrorCode::unreadable);
  EXPECT_THAT(scan.error().message, testing::StartsWith("scan.pcd: "));
  EXPECT_THAT(scan.error().message, testing::EndsWith("."));
  return scan.error().message;
}

void expect_two_points(const Scan& scan) {
  ASSERT_EQ(scan.size(), 2U);
  EXPECT_EQ(scan.point(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scan.point(1), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(scan.finite_count, 2U);
}

TEST(Pcd, AsciiBinaryAndCompressedHoldTheSamePoints) {
  expect_two_points(read(Header().with(two_points)));
  expect_two_points(read(Header().with("DATA binary\n" + bytes(1.F, 2.F, 3.F, 4.F, 5.F, 6.F))));
  const std::string literal = bytes(std::uint8_t{23}) + bytes(1.F, 4.F, 2.F, 5.F, 3.F, 6.F);
  expect_two_points(read(Header().with("DATA binary_compressed\n" + bytes(25U, 24U) + literal)));
}

TEST(Pcd, EveryFieldTypeIsReadAsWhatItIs) {
  const Header wide{.fields = "FIELDS x y z a b c d e\nSIZE 8 4 1 2 8 1 2 4\nTYPE F F I I I U U U\n",
                    .grid = "WIDTH 1\nHEIGHT 1\n",
                    .points = "POINTS 1\n"};
  const Scan scan =
      read(wide.with("DATA binary\n" + bytes(1.5, 2.5F, std::int8_t{-3}, std::int16_t{1}, std::int64_t{2},
                                             std::uint8_t{3}, std::uint16_t{4}, std::uint32_t{5})));
  EXPECT_EQ(scan.point(0), Eigen::Vector3d(1.5, 2.5, -3));
  std::vector<std::string> types;
  for (const FieldInfo& field : scan.fields) types.push_back(field.type);
  EXPECT_THAT(types,
              ElementsAre("float64", "float32", "int8", "int16", "int64", "uint8", "uint16", "uint32"));
  const std::string integers = "FIELDS x y z\nSIZE 2 4 8\nTYPE U U U\n";
  EXPECT_EQ(
      read(Header{.fields = integers}.with("DATA binary\n" + bytes(std::uint16_t{1}, 2U, std::uint64_t{3},
                                                                   std::uint16_t{4}, 5U, std::uint64_t{6})))
          .point(1),
      Eigen::Vector3d(4, 5, 6));
}

TEST(Pcd, FieldsOfCountZeroTwoAndPaddingAreSteppedOver) {
  const std::string fields = "FIELDS _ x n y _ z\nSIZE 1 4 4 4 1 4\nTYPE U F F F U F\nCOUNT 3 1 2 1 0 1\n";
  const auto point = [](float x, float y, float z) {
    return std::string("\1\2\3", 3) + bytes(x, 9.F, 9.F, y, z);
  };
  const Scan scan = read(Header{.fields = fields}.with("DATA binary\n" + point(1, 2, 3) + point(4, 5, 6)));
  expect_two_points(scan);
  EXPECT_EQ(scan.fields[2].count, 2U);
  expect_two_points(read(Header{.fields = fields}.with("DATA ascii\n0 0 0 1 8 8 2 3\n0 0 0 4 8 8 5 6\n")));
}

TEST(Pcd, OldVersionsAndMissingOptionalLinesAreRead) {
  for (const char* version : {"", "VERSION .5\n", "VERSION 0.6\n", "VERSION .7\n"}) {
    expect_two_points(read(Header{.version = version}.with(two_points)));
  }
  expect_two_points(read(Header{.fields = "COLUMNS x y z\nSIZE 4 4 4\nTYPE F F F\n"}.with(two_points)));
  EXPECT_THAT(read(Header{.grid = "WIDTH 2\n"}.with(two_points)).notices, Contains(HasSubstr("HEIGHT")));
  expect_two_points(read(Header{.grid = ""}.with(two_points)));
}

TEST(Pcd, WindowsLineEndsBlankLinesAndAByteOrderMarkDoNotMatter) {
  std::string file = Header().with(two_points + "\n \n");
  for (std::size_t at = 0; (at = file.find('\n', at)) != std::string::npos; at += 2) file.insert(at, "\r");
  expect_two_points(read(file));
  const Result<Scan> marked = read_scan_bytes("\xEF\xBB\xBF" + Header().with(two_points), "scan.pcd");
  ASSERT_TRUE(marked) << marked.error().message;
  expect_two_points(*marked);
}

TEST(Pcd, FirstPointMayStandOnTheDataLine) {
  const Scan scan = read(Header().with("DATA ascii1 2 3\n4 5 6\n"));
  expect_two_points(scan);
  EXPECT_THAT(scan.notices, Contains(HasSubstr("DATA line")));
}

TEST(Pcd, BytesAfterTheLastPointAreLeftOutWithANotice) {
  const std::string data = "DATA binary\n" + bytes(1.F, 2.F, 3.F, 4.F, 5.F, 6.F);
  EXPECT_THAT(read(Header().with(data + "abc")).notices, Contains(HasSubstr("3 bytes after the last point")));
  EXPECT_THAT(read(Header().with(data)).notices, Not(Contains(HasSubstr("after the last point"))));
  EXPECT_THAT(read(Header().with(two_points + "7 8 9\n")).notices, Contains(HasSubstr("6 bytes after")));
}

TEST(Pcd, ViewpointQuaternionIsReordered) {
  const Scan scan = read(Header{.viewpoint = "VIEWPOINT 1 2 3 0.5 -0.5 0.5 0.5\n"}.with(two_points));
  EXPECT_TRUE(scan.viewpoint.stated);
  EXPECT_EQ(scan.viewpoint.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scan.viewpoint.quaternion_xyzw, (std::array<double, 4>{-0.5, 0.5, 0.5, 0.5}));
  EXPECT_THAT(scan.notices, IsEmpty());
}

TEST(Pcd, ViewpointThatSaysNothingIsAnAssumptionWithANotice) {
  for (const char* line :
       {"", "VIEWPOINT 0 0 0 1 0 0 0\n", "VIEWPOINT 0 0 0 -1 0 0 0\n", "VIEWPOINT 1 2 3\n",
        "VIEWPOINT 1 2 3 nan 0 0 0\n", "VIEWPOINT 1 2 3 0 0 0 0\n", "VIEWPOINT 1 2 3 1.01 0 0 0\n"}) {
    const Scan scan = read(Header{.viewpoint = line}.with(two_points));
    EXPECT_FALSE(scan.viewpoint.stated) << line;
    EXPECT_EQ(rotation(scan.viewpoint), Eigen::Matrix3d::Identity()) << line;
    EXPECT_EQ(scan.viewpoint.position, Eigen::Vector3d::Zero()) << line;
    EXPECT_THAT(scan.notices, Contains(HasSubstr("taken to be at the origin"))) << line;
  }
}

TEST(Pcd, PointsInTheSensorFrameAreMovedByTheViewpoint) {
  // A quarter turn about z, then a metre along x.
  const double c = std::numbers::sqrt2 / 2;
  const std::string line = "VIEWPOINT 1 0 0 " + std::to_string(c) + " 0 0 " + std::to_string(c) + "\n";
  const std::string fields =
      "FIELDS x y z cov_xx cov_xy cov_xz cov_yy cov_yz cov_zz\nSIZE 4 4 4 8 8 8 8 8 8\n"
      "TYPE F F F F F F F F F\n";
  const std::string data = "DATA ascii\n1 2 3 4 1 0 9 0 25\n4 5 6 1 0 0 1 0 1\n";
  const Scan scan =
      read(Header{.fields = fields, .viewpoint = line}.with(data), {.points_in_sensor_frame = true});
  EXPECT_TRUE(scan.point(0).isApprox(Eigen::Vector3d(-1, 1, 3), 1e-6));
  const Covariance6 expected = {9, -1, 0, 4, 0, 25};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(scan.covariances[0][k], expected[k], 1e-5) << k;
}

TEST(Pcd, ColoursComeFromPackedBytesOfAnyType) {
  const std::uint32_t orange = 0xFF8000;
  float packed;
  std::memcpy(&packed, &orange, sizeof packed);
  const auto data = [](auto colour) {
    return "DATA binary\n" + bytes(1.F, 2.F, 3.F, colour, 4.F, 5.F, 6.F, colour);
  };
  const std::string as_float = "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\n";
  const std::string as_integer = "FIELDS x y z rgba\nSIZE 4 4 4 4\nTYPE F F F U\n";
  const auto is_orange = ElementsAre(ElementsAre(255, 128, 0), ElementsAre(255, 128, 0));
  EXPECT_THAT(read(Header{.fields = as_float}.with(data(packed))).colours, is_orange);
  EXPECT_THAT(read(Header{.fields = as_integer}.with(data(orange))).colours, is_orange);
  EXPECT_THAT(read(Header{.fields = as_integer}.with("DATA ascii\n1 2 3 16744448\n4 5 6 16744448\n")).colours,
              is_orange);
}

TEST(Pcd, LabelsThatAreNoneAreZeroWithANotice) {
  const std::string fields = "FIELDS label x y z\nSIZE 4 4 4 4\nTYPE I F F F\n";
  const Scan scan = read(Header{.fields = fields}.with("DATA ascii\n-1 1 2 3\n20 4 5 6\n"));
  EXPECT_THAT(scan.labels, ElementsAre(0U, 20U));
  EXPECT_THAT(scan.notices, Contains(HasSubstr("no label: 1 of them")));
}

TEST(Pcd, IntensitiesAreReadByAnyOfTheirNames) {
  for (const std::string name : {"intensity", "reflectivity"}) {
    const std::string fields = "FIELDS x y z " + name + "\nSIZE 4 4 4 2\nTYPE F F F U\n";
    const Scan scan = read(Header{.fields = fields}.with("DATA ascii\n1 2 3 70\n4 5 6 900\n"));
    EXPECT_THAT(scan.intensities, ElementsAre(70.0F, 900.0F)) << name;
  }
}

TEST(Pcd, CovariancesAreReadInEachOfTheirForms) {
  const auto covariance = [](const std::string& fields, const std::string& values) {
    const Header one{.fields = fields, .grid = "WIDTH 1\nHEIGHT 1\n", .points = "POINTS 1\n"};
    const Scan scan = read(one.with("DATA ascii\n0 0 2 " + values + "\n"));
    return scan.covariances.empty() ? Covariance6{} : scan.covariances[0];
  };
  const Covariance6 expected = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(
      covariance(
          "FIELDS x y z cov_xx cov_xy cov_xz cov_yy cov_yz cov_zz\nSIZE 4 4 4 4 4 4 4 4 4\nTYPE F F F F F F F F F\n",
          "1 2 3 4 5 6"),
      expected);
  EXPECT_EQ(covariance("FIELDS x y z covariance\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 6\n", "1 2 3 4 5 6"),
            expected);
  EXPECT_EQ(
      covariance("FIELDS x y z covariance\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 9\n", "1 2 3 2 4 5 3 5 6"),
      expected);
  EXPECT_EQ(covariance("FIELDS x y z sigma\nSIZE 4 4 4 4\nTYPE F F F F\n", "0.5"),
            (Covariance6{0.25, 0, 0, 0.25, 0, 0.25}));
  EXPECT_EQ(covariance("FIELDS x y z sigma_range sigma_lateral\nSIZE 4 4 4 4 4\nTYPE F F F F F\n", "3 0.5"),
            (Covariance6{0.25, 0, 0, 0.25, 0, 9}));
}

TEST(Pcd, HalfACovarianceAndAnAsymmetricOneAreRefused) {
  EXPECT_THAT(refusal(Header{.fields = "FIELDS x y z cxx cyy\nSIZE 4 4 4 4 4\nTYPE F F F F F\n"}.with(
                  "DATA ascii\n1 2 3 1 1\n1 2 3 1 1\n")),
              HasSubstr("'cxy' is missing"));
  const std::string nine = "FIELDS x y z covariance\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 9\n";
  EXPECT_THAT(
      refusal(Header{.fields = nine}.with("DATA ascii\n1 2 3 1 0 0 0 1 0 0 0 1\n1 2 3 1 7 0 0 1 0 0 0 1\n")),
      HasSubstr("covariance of point 1 is not symmetric"));
}

TEST(Pcd, EachPointMayHaveItsOwnSensorPosition) {
  const std::string fields = "FIELDS x y z vp_x vp_y vp_z\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n";
  const Scan scan = read(Header{.fields = fields}.with("DATA ascii\n1 2 3 0 0 1\n4 5 6 0 0 2\n"));
  EXPECT_THAT(scan.viewpoints, ElementsAre(Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, 2)));
}

TEST(Pcd, PointsWithoutFiniteCoordinatesAreCountedOut) {
  const Scan scan = read(Header().with("DATA ascii\nnan nan nan\n1e300 5 6\n"));
  EXPECT_EQ(scan.finite_count, 0U);
  EXPECT_THAT(scan.finite, ElementsAre(0, 0));
  EXPECT_TRUE(std::isnan(scan.positions[1].x()));
  EXPECT_THAT(scan.notices, Contains(HasSubstr("None of the points")));
}

TEST(Pcd, FloatCoordinatesKeepTheirBitsWhereverTheyLie) {
  const std::string near = "DATA binary\n" + bytes(0.1F, -7.3F, 1e-20F, 0.2F, 950.7F, 3.F);
  const Scan local = read(Header().with(near));
  EXPECT_EQ(local.origin, Eigen::Vector3d::Zero());
  EXPECT_EQ(local.positions[0], Eigen::Vector3f(0.1F, -7.3F, 1e-20F));
  const Scan map =
      read(Header().with("DATA binary\n" + bytes(512345.6F, 5403210.5F, 3.3F, 512001.1F, 5403000.5F, 4.4F)));
  EXPECT_NE(map.origin.y(), 0.0);
  EXPECT_EQ(map.point(0), Eigen::Vector3f(512345.6F, 5403210.5F, 3.3F).cast<double>());
  EXPECT_EQ(map.point(1), Eigen::Vector3f(512001.1F, 5403000.5F, 4.4F).cast<double>());
}

TEST(Pcd, DoubleCoordinatesOfAMapKeepTheirDigits) {
  const std::string fields = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\n";
  const Scan binary = read(Header{.fields = fields}.with(
      "DATA binary\n" + bytes(512345.678, 5403210.987, 3.3, 512345.789, 5403211.123, 3.4)));
  EXPECT_TRUE(binary.point(0).isApprox(Eigen::Vector3d(512345.678, 5403210.987, 3.3), 1e-14));
  const Scan text =
      read(Header().with("DATA ascii\n512345.678 5403210.987 3.3\n512345.789 5403211.123 3.4\n"));
  EXPECT_NEAR(text.point(1).y(), 5403211.123, 1e-7);
}

TEST(Pcd, AColumnOfPointsIsNotAGrid) {
  EXPECT_FALSE(read(Header{.grid = "WIDTH 1\nHEIGHT 2\n"}.with(two_points)).organized());
  const Header grid{.grid = "WIDTH 2\nHEIGHT 2\n", .points = "POINTS 4\n"};
  EXPECT_TRUE(read(grid.with(two_points + "7 8 9\n1 1 1\n")).organized());
}

TEST(Pcd, ClaimsAreHeldAgainstTheBytesThatFollow) {
  EXPECT_THAT(refusal(Header{.grid = "WIDTH 4000000000\nHEIGHT 1\n", .points = "POINTS 4000000000\n"}.with(
                  "DATA binary\nabc")),
              HasSubstr("48000000000 bytes"));
  EXPECT_THAT(
      refusal(Header{.grid = "WIDTH 900000000\nHEIGHT 1\n", .points = "POINTS 900000000\n"}.with(two_points)),
      HasSubstr("cut off"));
  EXPECT_THAT(refusal(Header().with("DATA ascii\n1 2 3\n     \n")),
              HasSubstr("promises 2 points, but 1 follow"));
  EXPECT_THAT(refusal(Header().with("DATA binary_compressed\n" + bytes(4U, 24U) + "abcd")),
              HasSubstr("damaged"));
  EXPECT_THAT(refusal(Header().with("DATA binary_compressed\n" + bytes(4U, 23U) + "abcd")),
              HasSubstr("claim 23 bytes"));
}

TEST(Pcd, MoreMemoryThanTheLimitIsRefused) {
  EXPECT_THAT(refusal(Header().with(two_points), {.memory_limit = 25}), HasSubstr("more than the limit"));
}

TEST(Pcd, LinesAtFaultAreNamed) {
  EXPECT_THAT(refusal(Header().with("DATA ascii\n1 2 3\n4 five 6\n")),
              HasSubstr("line 13: 'five' for field 'y'"));
  EXPECT_THAT(refusal(Header().with("DATA ascii\n1 2 3\n4 555\n")), HasSubstr("line 13: has 2 values"));
  EXPECT_THAT(refusal(Header().with("DATA ascii\n1 2 3 4\n5 6 7\n")), HasSubstr("line 12: has more values"));
  EXPECT_THAT(refusal(Header().with("DATA ascii\n1,5 2 3\n4 5 6\n")), HasSubstr("'1,5'"));
  EXPECT_THAT(refusal(Header{.version = "VERSION 9\n"}.with(two_points)),
              HasSubstr("line 2: the PCD version"));
  EXPECT_THAT(refusal(Header{.version = "WHAT 1\n"}.with(two_points)), HasSubstr("'WHAT' is not an entry"));
  EXPECT_THAT(refusal(Header{.version = "POINTS 2\n"}.with(two_points)),
              HasSubstr("stands in line 2 already"));
  EXPECT_THAT(refusal(Header().with("DATA base64\n")), HasSubstr("line 11: DATA must be"));
}

struct BadFields {
  const char* fields;
  const char* message;
};

TEST(Pcd, FieldsThatMakeNoSenseAreRefused) {
  const BadFields table[] = {
      {"SIZE 4 4 4\nTYPE F F F\n", "no FIELDS line"},
      {"FIELDS x y z\nTYPE F F F\n", "no SIZE line"},
      {"FIELDS x y z\nSIZE 4 4\nTYPE F F F\n", "SIZE has 2 entries where FIELDS has 3"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1\n", "COUNT has 2 entries"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 -1\n", "not '-1'"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 5000\n", "not '5000'"},
      {"FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\n", "SIZE '3'"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F X\n", "TYPE 'X'"},
      {"FIELDS x y z\nSIZE 4 4 2\nTYPE F F F\n", "SIZE '2'"},
      {"FIELDS x y y\nSIZE 4 4 4\nTYPE F F F\n", "'y' is named twice"},
      {"FIELDS x y w\nSIZE 4 4 4\nTYPE F F F\n", "no field 'z'"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 3\n", "no field 'z' with one value"},
      {"FIELDS x y z w\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 600\n", "more than 4096 bytes"},
  };
  for (const BadFields& row : table) {
    const std::string numbers(10000, '7');
    EXPECT_THAT(refusal(Header{.fields = row.fields}.with("DATA binary\n" + numbers)), HasSubstr(row.message))
        << row.fields;
  }
}

TEST(Pcd, NumbersOfPointsThatMakeNoSenseAreRefused) {
  for (const char* points : {"POINTS 0\n", "POINTS -2\n", "POINTS 2.0\n", "POINTS two\n",
                             "POINTS 4294967298\n", "POINTS\n", "POINTS 2 2\n", "POINTS 3\n", ""}) {
    EXPECT_THAT(refusal(Header{.points = points}.with(two_points)), HasSubstr("POINTS")) << points;
  }
  EXPECT_THAT(refusal(Header{.grid = "HEIGHT 2\n"}.with(two_points)), HasSubstr("no WIDTH"));
  EXPECT_THAT(refusal(Header{.grid = "WIDTH 65536\nHEIGHT 65536\n"}.with(two_points)),
              HasSubstr("65536 x 65536"));
}

TEST(Pcd, HeadersWithoutEndAreRefused) {
  EXPECT_THAT(refusal("# .PCD"), HasSubstr("without a DATA line"));
  EXPECT_THAT(refusal("VERSION 0.7\r# .PCD\rFIELDS x y z\r"), HasSubstr("carriage return"));
  EXPECT_THAT(refusal("# .PCD " + std::string(5000, 'a') + "\n"), HasSubstr("too long"));
  std::string comments = "# .PCD\n";
  while (comments.size() < 80000) comments += "# a comment that goes on and on\n";
  EXPECT_THAT(refusal(comments + Header().with(two_points)), HasSubstr("too long"));
}

TEST(Pcd, CoordinatesOfTheOtherByteOrderOrTypeAreRefused) {
  std::string reversed = bytes(1.F, 2.F, 3.F, 4.F, 5.F, 6.F);
  for (std::size_t i = 0; i < reversed.size(); i += 4)
    std::reverse(reversed.begin() + static_cast<int>(i), reversed.begin() + static_cast<int>(i) + 4);
  EXPECT_THAT(refusal(Header().with("DATA binary\n" + reversed)), HasSubstr("byte order"));
  const std::string integers = "FIELDS x y z\nSIZE 4 4 4\nTYPE I I I\n";
  EXPECT_THAT(refusal(Header{.fields = integers}.with("DATA binary\n" + bytes(1.F, 2.F, 3.F, 4.F, 5.F, 6.F))),
              HasSubstr("not the int32 numbers"));
}

TEST(Pcd, ReadingStopsWhenAskedTo) {
  Header many{.grid = "WIDTH 70000\nHEIGHT 1\n", .points = "POINTS 70000\n"};
  std::string data = "DATA ascii\n";
  for (int i = 0; i < 70000; ++i) data += "1 2 3\n";
  double last = 0.0;
  const Result<Scan> scan = read_pcd(many.with(data), "scan.pcd", {.progress = [&](double fraction) {
                                       last = fraction;
                                       return false;
                                     }});
  ASSERT_FALSE(scan);
  EXPECT_EQ(scan.error().code, ErrorCode::cancelled);
  EXPECT_GT(last, 0.9);
}

}  // namespace
}  // namespace patchlab
