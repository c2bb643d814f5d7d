#include "engine/io/glimpse.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <set>

#include "engine/base/file.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t points = 40'000;
constexpr GlimpseSize small_size{2000, 1000};

// Of point i, so that each tells which it is: x = i, y = 2 i, z = 3 i.
std::string records() {
  std::string bytes;
  for (std::size_t i = 0; i < points; ++i) {
    for (const std::size_t factor : {1, 2, 3}) {
      const auto value = std::bit_cast<std::array<char, 4>>(static_cast<float>(factor * i));
      bytes.append(value.data(), value.size());
    }
  }
  return bytes;
}

std::string rows() {
  std::string text;
  for (std::size_t i = 0; i < points; ++i) {
    text += std::to_string(i) + " " + std::to_string(2 * i) + " " + std::to_string(3 * i) + "\n";
  }
  return text;
}

std::string pcd(const std::string& encoding, const std::string& body) {
  return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 200\nHEIGHT 200\nVIEWPOINT 0 0 1 1 0 0 0\n"
         "POINTS 40000\nDATA " +
         encoding + "\n" + body;
}

std::string ply(const std::string& format, const std::string& faces, const std::string& body) {
  return "ply\nformat " + format + " 1.0\ncomment made here\nelement vertex 40000\nproperty float x\n" +
         "property float y\nproperty float z\n" + faces + "end_header\n" + body;
}

class GlimpseTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "patchlab_glimpse_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::optional<Scan> glimpse(const std::string& name, const std::string& bytes,
                              const GlimpseSize& size = small_size) const {
    EXPECT_TRUE(write_file(folder_ / name, bytes));
    return glimpse_scan(folder_ / name, {}, size);
  }
  fs::path folder_;
};

void expect_points_of_all_parts(const std::optional<Scan>& scan) {
  ASSERT_TRUE(scan);
  EXPECT_GE(scan->size(), small_size.points / 2);
  EXPECT_LE(scan->size(), small_size.points * 2);
  EXPECT_FALSE(scan->organized());
  std::set<int> tenths;
  for (std::size_t i = 0; i < scan->size(); ++i) {
    const Eigen::Vector3d p = scan->point(i);
    ASSERT_EQ(p.x(), std::round(p.x()));
    ASSERT_EQ(p.y(), 2 * p.x());
    ASSERT_EQ(p.z(), 3 * p.x());
    tenths.insert(static_cast<int>(10 * p.x() / points));
  }
  EXPECT_EQ(tenths.size(), 10U);
}

TEST_F(GlimpseTest, HoldsPointsOfAllPartsOfAPcd) {
  expect_points_of_all_parts(glimpse("binary.pcd", pcd("binary", records())));
  expect_points_of_all_parts(glimpse("ascii.pcd", pcd("ascii", rows())));
  EXPECT_EQ(glimpse("seen.pcd", pcd("binary", records()))->viewpoint.position.z(), 1.0);
}

TEST_F(GlimpseTest, HoldsPointsOfAllPartsOfAPly) {
  expect_points_of_all_parts(glimpse("cloud.ply", ply("binary_little_endian", "", records())));
  expect_points_of_all_parts(glimpse("text.ply", ply("ascii", "", rows())));
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string face("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
  expect_points_of_all_parts(glimpse("mesh.ply", ply("binary_little_endian", faces, records() + face)));
}

TEST_F(GlimpseTest, HoldsPointsOfAllPartsOfATable) {
  expect_points_of_all_parts(glimpse("headed.csv", "x y z\n" + rows()));
  expect_points_of_all_parts(glimpse("bare.xyz", rows()));
}

TEST_F(GlimpseTest, IsNotTakenOfASmallFile) {
  EXPECT_FALSE(glimpse("a.pcd", pcd("binary", records()), {2000, 1 << 20}));
  EXPECT_FALSE(glimpse("b.pcd", pcd("binary", records()), {50'000, 1000}));
}

TEST_F(GlimpseTest, LeavesWhatItCannotSkipToTheReader) {
  EXPECT_FALSE(glimpse("compressed.pcd", pcd("binary_compressed", records())));
  EXPECT_FALSE(glimpse("cut.pcd", pcd("binary", records().substr(0, 100'000))));
  EXPECT_FALSE(glimpse("mesh.ply", ply("ascii", "element face 1\nproperty list uchar int vertex_indices\n",
                                       rows() + "3 0 1 2\n")));
  EXPECT_FALSE(glimpse("no.pcd", "VERSION 0.7\nFIELDS x y z\n" + records()));
  EXPECT_FALSE(glimpse_scan(folder_ / "missing.pcd", {}, small_size));
}

}  // namespace
}  // namespace patchlab
