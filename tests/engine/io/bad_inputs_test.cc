// Malformed files by hand (../shared/bad_inputs): each is refused with a sentence, or read rightly. The table
// holds the ones that are read, each looked at: what they hold is what their headers say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::HasSubstr;

struct Expected {
  std::size_t points, finite;
  const char* notice;  // part of one
};

constexpr const char* origin = "taken to be at the origin";

// Ten points from (0, 0, 1) to (0.9, 1.8, 1.09), where nothing else is said.
const std::map<std::string, Expected> accepted = {
    {"blanklines_ascii.pcd", {10, 10, origin}},
    {"crlf_ascii.pcd", {10, 10, origin}},
    {"crlf_binary.pcd", {10, 10, origin}},
    {"crlf_comp.pcd", {10, 10, origin}},
    {"data_upper.pcd", {10, 10, origin}},
    {"inf_ascii.pcd", {10, 0, "None of the points"}},
    {"less_ascii_declared.pcd", {8, 8, "26 bytes after the last point"}},
    {"miss_COUNT.pcd", {10, 10, origin}},
    {"miss_HEIGHT.pcd", {10, 10, "no HEIGHT line"}},
    {"miss_VERSION.pcd", {10, 10, origin}},
    {"miss_VIEWPOINT.pcd", {10, 10, "states no viewpoint"}},
    {"missb_COUNT.pcd", {10, 10, origin}},
    {"missb_HEIGHT.pcd", {10, 10, "no HEIGHT line"}},
    {"missb_VERSION.pcd", {10, 10, origin}},
    {"missb_VIEWPOINT.pcd", {10, 10, "states no viewpoint"}},
    {"nan_ascii.pcd", {10, 0, "None of the points"}},
    {"noext", {10, 10, origin}},
    {"nonewline_data.pcd", {10, 10, "on the DATA line"}},
    {"nonutf8_\xFF\xFE\x80.pcd", {10, 10, origin}},
    {"ok_ascii.pcd", {10, 10, origin}},
    {"ok_binary.pcd", {10, 10, origin}},
    {"ok_comp.pcd", {10, 10, origin}},
    {"pts_less_bin.pcd", {8, 8, "24 bytes after the last point"}},
    {"type_F8.pcd", {10, 10, origin}},
    {"type_F8_ascii.pcd", {10, 10, origin}},
    {"utf8bom.pcd", {10, 10, origin}},
    {"vp_nan.pcd", {10, 10, "not seven numbers with a unit quaternion"}},
    {"vp_short.pcd", {10, 10, "not seven numbers with a unit quaternion"}},
    {"vp_text.pcd", {10, 10, "not seven numbers with a unit quaternion"}},
    {"vp_zeroq.pcd", {10, 10, "not seven numbers with a unit quaternion"}},
    {"ünïcødé_点群 space'q.pcd", {10, 10, origin}},
};

std::vector<std::filesystem::path> bad_inputs() {
  const std::filesystem::path folder = PATCHLAB_SOURCE_DIR "/../shared/bad_inputs";
  std::vector<std::filesystem::path> files;
  if (!exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename() != "handmade.tsv") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

void expect_read_rightly(const Scan& scan, const Expected& expected) {
  EXPECT_EQ(scan.size(), expected.points);
  EXPECT_EQ(scan.finite_count, expected.finite);
  EXPECT_THAT(scan.notices, Contains(HasSubstr(expected.notice)));
  for (std::size_t i = 0; i < scan.size() && expected.finite > 0; ++i) {
    const double k = static_cast<double>(i);
    EXPECT_LT((scan.point(i) - Eigen::Vector3d(0.1 * k, 0.2 * k, 1.0 + 0.01 * k)).norm(), 1e-6) << i;
  }
}

TEST(BadInputs, AreRefusedWithASentenceOrReadRightly) {
  const std::vector<std::filesystem::path> files = bad_inputs();
  if (files.empty()) GTEST_SKIP() << "the shared files are not here";
  std::size_t read = 0;
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    const Result<Scan> scan = read_scan(file);
    const auto expected = accepted.find(file.filename().string());
    if (scan) {
      ++read;
      ASSERT_NE(expected, accepted.end()) << "is accepted, but nobody has looked at it";
      expect_read_rightly(*scan, expected->second);
    } else {
      EXPECT_EQ(expected, accepted.end()) << scan.error().message;
      EXPECT_EQ(scan.error().code, ErrorCode::unreadable);
      EXPECT_THAT(scan.error().message, testing::StartsWith(file.string() + ": "));
      EXPECT_GT(scan.error().message.size(), file.string().size() + 10);
    }
  }
  EXPECT_EQ(read, accepted.size());
}

}  // namespace
}  // namespace patchlab
