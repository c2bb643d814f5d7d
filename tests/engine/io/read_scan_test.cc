// Formats are recognised by what files hold; what is not read is refused by name.
#include "engine/io/read_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace patchlab {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(std::string_view bytes) {
  const Result<Scan> scan = read_scan_bytes(bytes, "file");
  if (scan) return "accepted";
  EXPECT_EQ(scan.error().code, ErrorCode::unreadable);
  EXPECT_THAT(scan.error().message, StartsWith("file: "));
  EXPECT_THAT(scan.error().message, EndsWith("."));
  return scan.error().message;
}

TEST(ReadScan, RecognisesPcdAndTablesByTheirContent) {
  const std::string pcd =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n";
  for (const std::string& text : {"# .PCD v.7\n" + pcd, "# made by hand\n\nVERSION .7\n" + pcd, pcd}) {
    const Result<Scan> scan = read_scan_bytes(text, "file");
    ASSERT_TRUE(scan) << scan.error().message;
    EXPECT_EQ(scan->format, "pcd");
    EXPECT_EQ(scan->file, "file");
  }
  const Result<Scan> table = read_scan_bytes("\xEF\xBB\xBFx,y,z\n1,2,3\n", "file");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->format, "csv");
}

TEST(ReadScan, NamesWhatItDoesNotRead) {
  using namespace std::string_view_literals;
  const std::pair<std::string_view, const char*> table[] = {
      {"LASF\0\0\0\0"sv, "is a LAS or LAZ file; convert it with PDAL"},
      {"#ROSBAG V2.0\n", "is a ROS bag; save its clouds as PCD with 'rosrun pcl_ros bag_to_pcd"},
      {"\x89MCAP0\r\n", "is an MCAP recording; play it with 'ros2 bag play'"},
      {"\xFF\xFEv\0e\0"sv, "UTF-16; save it as UTF-8"},
      {"{\"version\": 1}", "is a JSON document"},
      {"5.85e2 0 320\n0 5.85e2 240\n0 0 1\n",
       "holds a matrix of 3 x 3 numbers and no points; give it as --intrinsics"},
      {"0 1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n", "holds a matrix of 4 x 4 numbers, the pose of a camera"},
      {"hello world", "in no format that is known"},
      {std::string_view("\0\1\2\3", 4), "in no format that is known"},
  };
  for (const auto& [bytes, what] : table) EXPECT_THAT(refusal(bytes), HasSubstr(what));
  EXPECT_THAT(refusal(""), HasSubstr("is empty"));
}

TEST(ReadScan, NamesWhatIsWrongWithATextThatIsCalledATable) {
  for (const auto& [text, name] : {std::pair{"x [m],y [m],z [m]\n1,2,3\n", "units.csv"},
                                   {"ncols 2\nnrows 1\n1 2\n", "grid.asc"},
                                   {"1.0D+00 2.0D+00 3.0D+00\n", "fortran.XYZ"}}) {
    const Result<Scan> scan = read_scan_bytes(text, name);
    ASSERT_FALSE(scan) << name;
    EXPECT_THAT(scan.error().message,
                HasSubstr("line 1: is neither a header row that names the columns x, y and z"));
  }
}

class ReadScanFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "patchlab_read_scan_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string refusal_of(const std::filesystem::path& file) const {
    const Result<Scan> scan = read_scan(file);
    return scan ? "accepted" : scan.error().message;
  }
  std::filesystem::path folder_;
};

TEST_F(ReadScanFile, OnlyRegularFilesAreOpened) {
  EXPECT_THAT(refusal_of(folder_), HasSubstr("is a folder"));
  EXPECT_THAT(refusal_of(folder_ / "missing.pcd"), HasSubstr("missing.pcd: cannot be opened"));
  const std::filesystem::path pipe = folder_ / "pipe.pcd";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal_of(pipe), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal_of("/dev/zero"), HasSubstr("not a regular file"));
  std::filesystem::create_symlink("loop.pcd", folder_ / "loop.pcd");
  EXPECT_THAT(refusal_of(folder_ / "loop.pcd"), HasSubstr("cannot be opened"));
}

TEST_F(ReadScanFile, ReportsItsProgressAndStopsWhereverItIsTold) {
  const std::filesystem::path file = folder_ / "a.ply";
  std::ofstream(file, std::ios::binary)
      << "ply\nformat binary_little_endian 1.0\nelement vertex 2000000\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n"
      << std::string(24'000'000, '\1');
  std::vector<double> reported;
  const auto read_until = [&](std::size_t last_call) {
    reported.clear();
    ReadOptions options;
    options.progress = [&](double fraction) {
      reported.push_back(fraction);
      return reported.size() < last_call;
    };
    return read_scan(file, options);
  };
  ASSERT_TRUE(read_until(1000));
  const std::size_t calls = reported.size();
  EXPECT_GE(calls, 4U) << "three pieces of the file, and the points";
  EXPECT_TRUE(std::ranges::is_sorted(reported));
  EXPECT_GE(reported.front(), 0.0);
  EXPECT_LE(reported.back(), 1.0);
  for (std::size_t call = 1; call <= calls; ++call) {
    const Result<Scan> scan = read_until(call);
    ASSERT_FALSE(scan);
    EXPECT_EQ(scan.error().code, ErrorCode::cancelled);
    EXPECT_EQ(reported.size(), call);
  }
}

TEST_F(ReadScanFile, ScanIsNamedAsTheUserNamedIt) {
  const std::filesystem::path file = folder_ / "points with spaces.csv";
  std::ofstream(file) << "x,y,z\n1,2,3\n";
  const Result<Scan> scan = read_scan(file);
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->file, file.string());
}

}  // namespace
}  // namespace patchlab
