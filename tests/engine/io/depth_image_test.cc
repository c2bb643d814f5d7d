// Depth images, and the intrinsics that must be said beside them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "engine/io/depth_image.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

constexpr Intrinsics camera = {.fx = 500, .fy = 400, .cx = 1, .cy = 0.5};
const ReadOptions millimetres = {.intrinsics = camera, .depth_scale = 1000};

// 3 x 2 depths: none, 1 m, 2 m / 0.256 m, 0.255 m, 65.535 m
const std::vector<std::uint16_t> depths = {0, 1000, 2000, 256, 255, 65535};

std::string pgm(const std::string& header = "P5\n# made here\n3 2\n65535\n") {
  std::string bytes = header;
  for (const std::uint16_t depth : depths) {
    bytes += static_cast<char>(depth >> 8);
    bytes += static_cast<char>(depth & 255);
  }
  return bytes;
}

void append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

std::string png(int bits, int colour) {
  std::string bytes;
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_set_write_fn(writer, &bytes, append, nullptr);
  png_set_IHDR(writer, info, 3, 2, bits, colour, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer, info);
  std::string samples = pgm("") + std::string(64, '\0');
  for (std::size_t row = 0; row < 2; ++row)
    png_write_row(writer, reinterpret_cast<png_bytep>(&samples[6 * row]));
  png_write_end(writer, nullptr);
  png_destroy_write_struct(&writer, &info);
  return bytes;
}

std::string depth_refusal(std::string_view bytes, const ReadOptions& options = millimetres) {
  const Result<Scan> scan = read_scan_bytes(bytes, "depth", options);
  return scan ? "accepted" : scan.error().message;
}

TEST(DepthImage, PixelsBecomePointsOfAGrid) {
  for (const std::string& bytes : {pgm(), png(16, PNG_COLOR_TYPE_GRAY)}) {
    const Result<Scan> scan = read_scan_bytes(bytes, "depth", millimetres);
    ASSERT_TRUE(scan) << scan.error().message;
    EXPECT_EQ(scan->width, 3u);
    EXPECT_EQ(scan->height, 2u);
    EXPECT_EQ(scan->finite_count, 5u);
    EXPECT_FALSE(scan->finite[0]);
    // pixel (2, 0) at 2 m: x = (2 - 1) 2/500, y = (0 - 0.5) 2/400
    EXPECT_LT((scan->point(2) - Eigen::Vector3d(0.004, -0.0025, 2)).norm(), 1e-7);
    EXPECT_NEAR(scan->point(3).z(), 0.256, 1e-7);
    EXPECT_NEAR(scan->point(5).z(), 65.535, 1e-5);
    EXPECT_TRUE(scan->viewpoint.stated);
    EXPECT_EQ(scan->intrinsics, (std::array<double, 4>{500, 400, 1, 0.5}));
  }
}

TEST(DepthImage, WhatItDoesNotSayIsAskedForByFlag) {
  const Result<Scan> bare = read_scan_bytes(pgm(), "depth");
  ASSERT_FALSE(bare);
  EXPECT_EQ(bare.error().code, ErrorCode::usage);
  EXPECT_THAT(bare.error().message, HasSubstr("--intrinsics fx,fy,cx,cy"));
  EXPECT_THAT(depth_refusal(pgm(), {.intrinsics = camera}), HasSubstr("give --depth-scale"));
  ReadOptions unit = millimetres;
  unit.unit = LengthUnit::mm;
  EXPECT_THAT(depth_refusal(pgm(), unit), HasSubstr("set by --depth-scale, not by --unit"));
}

TEST(DepthImage, IntrinsicsOfPicturesOfAnotherSizeAreRefused) {
  ReadOptions other = millimetres;
  other.intrinsics->width = 640;
  other.intrinsics->height = 480;
  EXPECT_THAT(depth_refusal(pgm(), other),
              HasSubstr("has 3 x 2 pixels, but the intrinsics are those of pictures of 640 x 480"));
}

TEST(DepthImage, PicturesOfAnotherKindAreRefused) {
  EXPECT_THAT(depth_refusal(png(8, PNG_COLOR_TYPE_GRAY)), HasSubstr("a grey picture of 8 bits"));
  EXPECT_THAT(depth_refusal(png(8, PNG_COLOR_TYPE_RGB)), HasSubstr("a colour picture of 8 bits"));
  EXPECT_THAT(depth_refusal("P5 3 2 255\n123456"), HasSubstr("8 bits a pixel"));
  EXPECT_THAT(depth_refusal("P6\n3 2\n65535\n"), HasSubstr("PNM family"));
}

TEST(DepthImage, DamagedPicturesAreRefusedBeforeMemoryIsTaken) {
  EXPECT_THAT(depth_refusal(pgm("P5\n3 3\n65535\n")), HasSubstr("12 bytes cannot hold 3 x 3 depths"));
  EXPECT_THAT(depth_refusal(pgm("P5\n3 2\n4095\n")), HasSubstr("holds the value 65535"));
  EXPECT_THAT(depth_refusal(pgm("P5\n99999 99999\n65535\n")), HasSubstr("are no sides of a depth image"));
  EXPECT_THAT(depth_refusal("P5\n3\n"), HasSubstr("one is missing"));
  const std::string whole = png(16, PNG_COLOR_TYPE_GRAY);
  EXPECT_THAT(depth_refusal(whole.substr(0, 50)), HasSubstr("damaged or cut off"));
  EXPECT_THAT(depth_refusal(whole.substr(0, 20)), HasSubstr("header of the PNG picture is damaged"));
  std::string flipped = whole;
  flipped[flipped.size() - 20] ^= 1;  // a checksum no longer holds
  EXPECT_THAT(depth_refusal(flipped), HasSubstr("damaged"));
}

void expect_camera(const char* text, bool sized, bool distorted) {
  const Result<Intrinsics> read = parse_intrinsics(text, "camera");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ((std::array{read->fx, read->fy, read->cx, read->cy}), (std::array{585.5, 586.0, 320.0, 240.25}));
  EXPECT_EQ(read->width, sized ? 640u : 0u);
  EXPECT_EQ(read->height, sized ? 480u : 0u);
  EXPECT_EQ(read->distorted, distorted);
}

TEST(IntrinsicsFile, AllThatSensorsLeaveIsRead) {
  expect_camera("585.5,586,320,240.25", false, false);
  expect_camera(" 5.855e+02\t 0 320\t\n 0 586 240.25\n 0 0 1\n", false, false);
  expect_camera("585.5 0 320 0\n0 586 240.25 0\n0 0 1 0\n0 0 0 1\n", false, false);
  expect_camera(
      R"({"width": 640, "height": 480, "intrinsic_matrix": [585.5, 0, 0, 0, 586, 0, 320, 240.25, 1]})", true,
      false);
  expect_camera(
      "image_width: 640\nimage_height: 480\ncamera_name: kinect\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [585.5, 0, 320, 0, 586, 240.25, 0, 0, 1]\ndistortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, 0, 0, 0, 0]\n",
      true, true);
  expect_camera("height: 480\nwidth: 640\nD: [0.0, 0.0]\nK: [585.5, 0, 320, 0, 586, 240.25, 0, 0, 1]\n---\n",
                true, false);
  expect_camera(
      "height: 480\nwidth: 640\nd: []\nk:\n- 585.5\n- 0.0\n- 320\n- 0.0\n- 586\n- 240.25\n- 0.0\n- 0.0\n- 1.0\n",
      true, false);
}

TEST(IntrinsicsFile, WhatIsNoPinholeCameraIsRefused) {
  for (const char* text :
       {"", "1,2,3", "0,500,1,1", "500 1 320 0 500 240 0 0 1", "1 2 3 4 5 6 7 8 9", "hello", "K: [1, 2]",
        "K: {a: b}", "{\"width\": 640}", "nan,1,1,1", "- [", "K: [x,0,1,0,1,1,0,0,1]"}) {
    const Result<Intrinsics> read = parse_intrinsics(text, "camera.yaml");
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().message, testing::StartsWith("camera.yaml: ")) << text;
  }
}

}  // namespace
}  // namespace patchlab
