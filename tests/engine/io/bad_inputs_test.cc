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
  const char* notice;                         // part of one
  std::vector<Eigen::Vector3d> corners = {};  // where the points lie, over and over
};

const std::vector<Eigen::Vector3d> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

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
    {"camera.ply", {10, 10, "three axes at right angles"}},
    {"crlf.ply", {10, 10, "'face' (2) was"}},
    {"crlf_bin.ply", {10, 10, "'face' (2) was"}},
    {"f_0gon.ply", {10, 10, "2 of them damaged"}},
    {"f_255gon.ply", {10, 10, "'face' (1) was"}},
    {"f_dup_vertex.ply", {10, 10, "'face' (2) was"}},
    {"f_idx_neg.ply", {10, 10, "1 of them damaged"}},
    {"f_idx_oob.ply", {10, 10, "1 of them damaged"}},
    {"f_less.ply", {10, 10, "8 bytes after the last point"}},
    {"face_before.ply", {10, 10, "'face' (1) was"}},
    {"fb_less.ply", {10, 10, "13 bytes after the last point"}},
    {"nan.ply", {10, 0, "None of the points"}},
    {"ok_ascii.ply", {10, 10, "'face' (2) was"}},
    {"ok_be.ply", {10, 10, "'face' (2) was"}},
    {"ok_bin.ply", {10, 10, "'face' (2) was"}},
    {"ok_nofaces.ply", {10, 10, origin}},
    {"p_alpha_only.ply", {10, 10, origin, {{1, 2, 3}}}},
    {"p_dbl.ply", {10, 10, origin}},
    {"p_intensity.ply", {10, 10, origin, {{2, 3, 255}}}},
    {"p_rgb_order.ply", {10, 10, origin, {{1, 2, 3}}}},
    {"p_rgba_float.ply", {10, 10, origin, {{1, 2, 3}}}},
    {"rangegrid.ply", {10, 10, "'range_grid' (10"}},
    {"rangegrid_oob.ply", {10, 10, "10 of them damaged"}},
    {"backslash.obj", {3, 3, "1 faces were", triangle}},
    {"colors.obj", {3, 3, "1 faces were", triangle}},
    {"crlf.obj", {10, 10, "1 faces were"}},
    {"degenerate.stl", {1, 1, "2 faces, 2 of them damaged", {{0, 0, 0}}}},
    {"dup.off", {3, 3, "3 faces were", triangle}},
    {"face_1.obj", {1, 1, "3 faces, 3 of them damaged", {{0, 0, 0}}}},
    {"face_first.obj", {3, 3, "1 faces were", triangle}},
    {"idx_huge.obj", {3, 3, "1 faces, 1 of them damaged", triangle}},
    {"idx_neg.obj", {3, 3, "1 faces were", triangle}},
    {"idx_neg.off", {10, 10, "2 faces, 1 of them damaged"}},
    {"idx_negoob.obj", {3, 3, "1 faces, 1 of them damaged", triangle}},
    {"idx_oob.obj", {3, 3, "1 faces, 1 of them damaged", triangle}},
    {"idx_oob.off", {10, 10, "2 faces, 1 of them damaged"}},
    {"idx_zero.obj", {3, 3, "1 faces, 1 of them damaged", triangle}},
    {"mtl_missing.obj", {3, 3, "1 faces were", triangle}},
    {"mtl_only.obj", {3, 3, "1 faces were", triangle}},
    {"mtl_traversal.obj", {3, 3, "1 faces were", triangle}},
    {"nan.obj", {3, 1, "1 faces were", {{4, 5, 6}}}},
    {"nan.off", {3, 1, "1 faces were", {{0, 0, 0}}}},
    {"nan.stl", {1, 0, "None of the points"}},
    {"nolf.obj", {3, 3, "1 faces were", triangle}},
    {"normidx.obj", {3, 3, "1 faces were", triangle}},
    {"ok.obj", {10, 10, "2 faces were"}},
    {"ok.off", {10, 10, "2 faces were"}},
    {"ok_ascii.stl", {3, 3, "1 faces were", triangle}},
    {"ok_bin.stl", {3, 3, "2 faces were", triangle}},
    {"poly_huge.off", {10, 10, "2 faces, 1 of them damaged"}},
    {"poly_neg.off", {10, 10, "2 faces, 1 of them damaged"}},
    {"slashes.obj", {3, 3, "1 faces, 1 of them damaged", triangle}},
    {"solid_bin.stl", {3, 3, "2 faces were", triangle}},
    {"texidx.obj", {3, 3, "1 faces were", triangle}},
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
    const Eigen::Vector3d in_a_row(0.1 * k, 0.2 * k, 1.0 + 0.01 * k);
    if (!scan.finite[i]) continue;
    const auto& corners = expected.corners;
    EXPECT_LT((scan.point(i) - (corners.empty() ? in_a_row : corners[i % corners.size()])).norm(), 1e-6) << i;
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
      EXPECT_NE(expected, accepted.end()) << "is accepted, but nobody has looked at it";
      if (expected != accepted.end()) expect_read_rightly(*scan, expected->second);
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
