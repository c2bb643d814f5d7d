#include "engine/io/scan_size.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/base/file.h"
#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

class ScanSizeTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "patchlab_scan_size_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::optional<ScanSize> foresee(const std::string& name, const std::string& bytes) const {
    EXPECT_TRUE(write_file(folder_ / name, bytes));
    return foresee_scan(folder_ / name);
  }
  fs::path folder_;
};

std::string ply(const std::string& type, std::size_t points, std::size_t bytes) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points) + "\nproperty " +
         type + " x\nproperty " + type + " y\nproperty " + type + " z\nend_header\n" +
         std::string(points * bytes, '\1');
}

TEST_F(ScanSizeTest, OfBinaryFloatsIsThatOfTheFileAndOfThePositions) {
  const std::string file = ply("float", 1000, 12);
  const auto size = foresee("a.ply", file);
  ASSERT_TRUE(size);
  EXPECT_TRUE(size->exact);
  EXPECT_EQ(size->points, 1000U);
  EXPECT_EQ(size->bytes, file.size() + 1000 * (sizeof(Eigen::Vector3f) + 1));
  EXPECT_GT(foresee("b.ply", ply("double", 1000, 24))->bytes, size->bytes);
}

TEST_F(ScanSizeTest, CountsWhatThePointsOfAPcdHaveBeside) {
  Scan scan;
  scan.width = 500;
  scan.positions.assign(500, Eigen::Vector3f(1, 2, 3));
  scan.finite.assign(500, 1);
  scan.finite_count = 500;
  const auto plain = foresee("plain.pcd", write_pcd(scan));
  scan.covariances.assign(500, {1e-6, 0, 0, 1e-6, 0, 1e-6});
  const auto rich = foresee("rich.pcd", write_pcd(scan));
  ASSERT_TRUE(plain && rich);
  EXPECT_EQ(plain->points, 500U);
  EXPECT_GE(rich->bytes - plain->bytes, 500 * sizeof(Covariance6));
}

TEST_F(ScanSizeTest, OfATableFollowsFromItsFirstLines) {
  std::string rows = "x,y,z\n";
  for (int i = 0; i < 20000; ++i) rows += "0.125,0.250,0.500\n";
  const auto size = foresee("a.csv", rows);
  ASSERT_TRUE(size);
  EXPECT_FALSE(size->exact);
  EXPECT_NEAR(static_cast<double>(size->points), 20000.0, 10.0);
}

TEST_F(ScanSizeTest, IsNotSaidWhereNothingTellsIt) {
  EXPECT_FALSE(foresee("a.png", "\x89PNG\r\n\x1A\n and so on"));
  EXPECT_FALSE(foresee("b.pcd",
                       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 4000000000\nHEIGHT 1\n"
                       "POINTS 4000000000\nDATA binary\nabc"));
  EXPECT_FALSE(foresee_scan(folder_));
  EXPECT_FALSE(foresee_scan(folder_ / "nothing.pcd"));
  EXPECT_FALSE(foresee_scan("-"));
}

}  // namespace
}  // namespace patchlab
