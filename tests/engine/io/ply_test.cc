// The PLY reader on small files written here, a rule each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string vertices = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";

std::string ascii(const std::string& elements, const std::string& data) {
  return "ply\nformat ascii 1.0\ncomment by hand\n" + elements + "end_header\n" + data;
}
std::string binary(const std::string& order, const std::string& elements, const std::string& data) {
  return "ply\nformat binary_" + order + "_endian 1.0\n" + elements + "end_header\n" + data;
}

// The bytes of the values, least significant first or last.
template <class... Values>
std::string bytes(const std::string& order, Values... values) {
  std::string all;
  const auto append = [&](const auto& value) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (order == "big") std::ranges::reverse(one);
    all += one;
  };
  (append(values), ...);
  return all;
}

Scan read(const std::string& file, const ReadOptions& options = {}) {
  Result<Scan> scan = read_scan_bytes(file, "scan.ply", options);
  if (!scan) ADD_FAILURE() << scan.error().message;
  return scan ? *std::move(scan) : Scan{};
}

std::string refusal(const std::string& file) {
  const Result<Scan> scan = read_scan_bytes(file, "scan.ply");
  if (scan) return "accepted";
  EXPECT_EQ(scan.error().code, ErrorCode::unreadable);
  EXPECT_THAT(scan.error().message, testing::StartsWith("scan.ply: "));
  EXPECT_THAT(scan.error().message, testing::EndsWith("."));
  return scan.error().message;
}

void expect_two_points(const Scan& scan) {
  ASSERT_EQ(scan.size(), 2U);
  EXPECT_EQ(scan.point(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scan.point(1), Eigen::Vector3d(4, 5, 6));
  EXPECT_FALSE(scan.organized());
}

TEST(Ply, TextAndBothByteOrdersHoldTheSamePoints) {
  expect_two_points(read(ascii(vertices, "1 2 3\n\n4 5 6\n")));
  for (const std::string order : {"little", "big"}) {
    const Scan scan = read(binary(order, vertices, bytes(order, 1.F, 2.F, 3.F, 4.F, 5.F, 6.F)));
    expect_two_points(scan);
    EXPECT_EQ(scan.encoding, "binary_" + order + "_endian");
    EXPECT_EQ(scan.format, "ply");
  }
}

TEST(Ply, DoublesStayDoubles) {
  const std::string doubles = "element vertex 1\nproperty double x\nproperty float64 y\nproperty float z\n";
  const Scan scan = read(binary("little", doubles, bytes("little", 512345.678, 5403210.987, 3.5F)));
  EXPECT_TRUE(scan.point(0).isApprox(Eigen::Vector3d(512345.678, 5403210.987, 3.5), 1e-14));
  EXPECT_EQ(scan.fields[0].type, "float64");
}

TEST(Ply, WindowsLineEndsDoNotMatter) {
  std::string file = ascii(vertices, "1 2 3\n4 5 6\n");
  for (std::size_t at = 0; (at = file.find('\n', at)) != std::string::npos; at += 2) file.insert(at, "\r");
  expect_two_points(read(file));
}

TEST(Ply, ElementsStandInAnyOrderAndUnknownOnesAreSteppedOver) {
  const std::string extra =
      "element odd 1\nproperty short a\nproperty list ushort double b\nproperty char c\n";
  expect_two_points(read(ascii(faces + extra + vertices, "3 0 1 0\n2 1 0\n7 2 0.5 0.5 1\n1 2 3\n4 5 6\n")));
  for (const std::string order : {"little", "big"}) {
    const std::string data = bytes(order, std::uint8_t{3}, 0, 1, 0, std::uint8_t{2}, 1, 0) +
                             bytes(order, std::int16_t{7}, std::uint16_t{2}, 0.5, 0.5, std::int8_t{1}) +
                             bytes(order, 1.F, 2.F, 3.F, 4.F, 5.F, 6.F);
    const Scan scan = read(binary(order, faces + extra + vertices, data));
    expect_two_points(scan);
    EXPECT_THAT(scan.notices, Contains(HasSubstr("'face' (2, 1 of them damaged) was left out")));
  }
}

TEST(Ply, ListsWithinVerticesAreSteppedOver) {
  const std::string elements =
      "element vertex 2\nproperty float x\nproperty list uchar int ring\nproperty float y\nproperty float z\n";
  expect_two_points(read(ascii(elements, "1 2 9 9 2 3\n4 0 5 6\n")));
  expect_two_points(read(binary(
      "big", elements, bytes("big", 1.F, std::uint8_t{1}, 9, 2.F, 3.F, 4.F, std::uint8_t{0}, 5.F, 6.F))));
}

TEST(Ply, DamagedFacesAreCounted) {
  const auto notices = [](const char* lines) {
    return read(ascii(vertices + faces, std::string("1 2 3\n4 5 6\n") + lines)).notices;
  };
  EXPECT_THAT(notices("3 0 1 0\n4 0 1 0 1\n"), Contains(HasSubstr("'face' (2) was left out")));
  EXPECT_THAT(notices("3 0 1 2\n3 0 1 -1\n"), Contains(HasSubstr("2 of them damaged")));
  EXPECT_THAT(notices("2 0 1\n3 0 1 0\n"), Contains(HasSubstr("1 of them damaged")));
}

TEST(Ply, FacesReadAsVerticesAreNoticed) {
  const std::string counts =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n" + faces;
  EXPECT_THAT(
      refusal(binary("little", counts, bytes("little", 1.F, 2.F, 3.F, 4.F, 5.F, 6.F) + std::string(2, '\0'))),
      HasSubstr("counts in its header are wrong"));
}

TEST(Ply, ColoursLabelsAndCovariancesAreRead) {
  const Scan scan = read(
      ascii("element vertex 1\nproperty uchar blue\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty int label\nproperty double sigma\n",
            "3 1 2 3 1 2 42 0.5\n"));
  EXPECT_THAT(scan.colours, ElementsAre(ElementsAre(1, 2, 3)));
  EXPECT_THAT(scan.labels, ElementsAre(42U));
  EXPECT_THAT(scan.covariances, ElementsAre(ElementsAre(0.25, 0, 0, 0.25, 0, 0.25)));
}

const std::string camera =
    "element camera 1\nproperty float view_px\nproperty float view_py\nproperty float view_pz\n"
    "property float x_axisx\nproperty float x_axisy\nproperty float x_axisz\n"
    "property float y_axisx\nproperty float y_axisy\nproperty float y_axisz\n"
    "property float z_axisx\nproperty float z_axisy\nproperty float z_axisz\n"
    "property int viewportx\nproperty int viewporty\n";

TEST(Ply, CameraIsTheViewpoint) {
  // x of the camera along y, y along -x.
  const Scan scan = read(ascii(camera + vertices, "1 2 3  0 1 0  -1 0 0  0 0 1  640 480\n1 2 3\n4 5 6\n"));
  expect_two_points(scan);
  EXPECT_TRUE(scan.viewpoint.stated);
  EXPECT_EQ(scan.viewpoint.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(
      (rotation(scan.viewpoint) * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(Ply, CameraThatSaysNothingIsAnAssumptionWithANotice) {
  for (const char* line : {"0 0 0  1 0 0  0 1 0  0 0 1  2 1\n", "1 2 3  1 0 0  1 0 0  0 0 1  2 1\n",
                           "1 2 3  -1 0 0  0 1 0  0 0 1  2 1\n", "nan 2 3  1 0 0  0 1 0  0 0 1  2 1\n"}) {
    const Scan scan = read(ascii(camera + vertices, line + std::string("1 2 3\n4 5 6\n")));
    expect_two_points(scan);
    EXPECT_FALSE(scan.viewpoint.stated) << line;
    EXPECT_THAT(scan.notices, Contains(HasSubstr("taken to be at the origin"))) << line;
  }
  EXPECT_THAT(read(ascii(vertices, "1 2 3\n4 5 6\n")).notices, Contains(HasSubstr("no single camera")));
}

TEST(Ply, ViewportOfTheSizeOfTheCloudIsItsGrid) {
  const std::string grid = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const Scan scan =
      read(ascii(grid + camera, "1 2 3\n4 5 6\n7 8 9\n1 1 1\n1 2 3  1 0 0  0 1 0  0 0 1  2 2\n"));
  EXPECT_TRUE(scan.organized());
  EXPECT_EQ(scan.width, 2U);
}

TEST(Ply, ClaimsAreHeldAgainstTheBytesThatFollow) {
  const std::string many =
      "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(refusal(ascii(many, "1 2 3\n")), HasSubstr("24000000000 bytes"));
  EXPECT_THAT(refusal(binary("little", many, "abc")), HasSubstr("48000000000 bytes"));
  EXPECT_THAT(
      refusal(binary("little", vertices + "element face 900000000\nproperty list uchar int vertex_indices\n",
                     bytes("little", 1.F, 2.F, 3.F, 4.F, 5.F, 6.F))),
      HasSubstr("cut off"));
  EXPECT_THAT(refusal(binary("little", "element face 1\nproperty list uint int vertex_indices\n" + vertices,
                             bytes("little", 4000000000U, 1.F, 2.F, 3.F, 4.F, 5.F, 6.F))),
              HasSubstr("cut off"));
  EXPECT_THAT(refusal(binary("little", "element face 1\nproperty list int int vertex_indices\n" + vertices,
                             bytes("little", -1, 1.F, 2.F, 3.F, 4.F, 5.F, 6.F))),
              HasSubstr("negative length"));
  EXPECT_THAT(refusal(ascii(vertices, "1 2 3\n          \n")), HasSubstr("cut off"));
}

TEST(Ply, LinesAtFaultAreNamed) {
  EXPECT_THAT(refusal(ascii(vertices, "1 2 3\n4 five 6\n")), HasSubstr("line 10: 'five' for 'y'"));
  EXPECT_THAT(refusal(ascii(vertices, "1 2 3\n4 5555\n")), HasSubstr("line 10: has no value for 'z'"));
  EXPECT_THAT(refusal(ascii(vertices, "1 2 3 4\n4 5 6\n")), HasSubstr("line 9: has more values"));
  EXPECT_THAT(refusal(ascii(vertices + faces, "1 2 3\n4 5 6\n3 0 1\n3 0 1 0\n")),
              HasSubstr("line 13: has no value"));
  EXPECT_THAT(refusal(ascii(vertices + faces, "1 2 3\n4 5 6\n1.5 0\n0\n")), HasSubstr("'1.5'"));
}

struct BadHeader {
  std::string header;
  const char* message;
};

TEST(Ply, HeadersThatMakeNoSenseAreRefused) {
  const std::string format = "format ascii 1.0\n";
  const BadHeader table[] = {
      {vertices, "no format"},
      {"format ascii 9.9\n", "version 1.0"},
      {"format binary_middle_endian 1.0\n", "must be ascii"},
      {format + format, "given twice"},
      {format + "element vertex -2\n", "whole number"},
      {format + "element vertex 18446744073709551615\n", "whole number"},
      {format + "element vertex ten\n", "whole number"},
      {format + "element vertex\n", "whole number"},
      {format + "property float x\n", "before the first element"},
      {format + "element vertex 1\nproperty quaternion x\n", "'quaternion' is not a type"},
      {format + "element vertex 1\nproperty list float int x\n", "whole number"},
      {format + "element vertex 1\nproperty float x\nproperty float x\n", "'x' is declared twice"},
      {format + vertices + "element vertex 2\nproperty float x\n", "'vertex' is declared twice"},
      {format + "element vertex 2\n", "no properties"},
      {format + "elephant vertex 2\n", "'elephant' is not an entry"},
      {format + "element vertex 0\nproperty float x\n", "no vertices"},
      {format + faces, "no vertices"},
      {format + "element vertex 2\nproperty float x\nproperty float y\nproperty float w\n", "no field 'z'"},
  };
  for (const BadHeader& row : table) {
    EXPECT_THAT(refusal("ply\n" + row.header + "end_header\n1 2 3\n4 5 6\n"), HasSubstr(row.message))
        << row.header;
  }
  EXPECT_THAT(refusal("ply\n" + format + vertices), HasSubstr("without end_header"));
  EXPECT_THAT(refusal("ply\ncomment " + std::string(5000, 'a')), HasSubstr("too long"));
  EXPECT_THAT(refusal("ply\rformat ascii 1.0\r"), HasSubstr("carriage return"));
}

TEST(Ply, CoordinatesOfTheOtherByteOrderAreRefused) {
  EXPECT_THAT(refusal(binary("big", vertices, bytes("little", 1.F, 2.F, 3.F, 4.F, 5.F, 6.F))),
              HasSubstr("byte order"));
}

TEST(Ply, BytesAfterTheLastElementAreLeftOutWithANotice) {
  EXPECT_THAT(read(ascii(vertices, "1 2 3\n4 5 6\n7 8 9\n")).notices, Contains(HasSubstr("6 bytes after")));
  EXPECT_THAT(read(ascii(vertices, "1 2 3\n4 5 6\n\n")).notices, Not(Contains(HasSubstr("after the last"))));
}

}  // namespace
}  // namespace patchlab
