// Small valid files, damaged at random: the readers refuse them with a sentence or give a scan that hangs
// together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>

#include "engine/io/read_scan.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

Scan small_scan() {
  Scan scan;
  scan.width = 4;
  scan.height = 3;
  for (int i = 0; i < 12; ++i) scan.positions.emplace_back(0.1F * static_cast<float>(i), 0.2F, 1.F);
  scan.finite.assign(12, 1);
  scan.finite_count = 12;
  scan.colours.assign(12, {1, 2, 3});
  scan.labels.assign(12, 7);
  scan.covariances.assign(12, {1e-6, 0, 0, 1e-6, 0, 1e-6});
  scan.viewpoint.position = {0, 0, 1};
  scan.viewpoint.stated = true;
  return scan;
}

const std::string header =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z _ label\nSIZE 4 8 4 1 2\nTYPE F F F U U\nCOUNT 1 1 1 0 1\nWIDTH 3\nHEIGHT 2\n"
    "VIEWPOINT 0 0 1 1 0 0 0\nPOINTS 6\n";

std::string ascii_file() {
  return header + "DATA ascii\n0 1 2 1\n1 1e0 2 2\n-2 1 .5 3\nnan nan nan 0\n3 3 3 4\n5 5 5 5\n";
}

std::string compressed_file() {
  std::string compressed("\3\0\0\0\0\xE0\x5F\0", 8);  // four zeros, and the last of them again and again
  const std::uint32_t sizes[] = {static_cast<std::uint32_t>(compressed.size()), 6 * 18};
  return header + "DATA binary_compressed\n" +
         std::string(reinterpret_cast<const char*>(sizes), sizeof sizes) + compressed;
}

std::string table_file() {
  return "x,y,z,cxx,cxy,cxz,cyy,cyz,czz,label\n1,2,3,1e-6,0,0,1e-6,0,1e-6,1\n4,5,6,1e-6,0,0,1e-6,0,1e-6,2\n";
}

std::string ply_file(const std::string& format, const std::string& data) {
  return "ply\nformat " + format +
         " 1.0\nelement face 1\nproperty list uchar ushort vertex_indices\nelement vertex 3\n"
         "property float x\nproperty double y\nproperty short z\nend_header\n" +
         data;
}
std::string ascii_ply_file() { return ply_file("ascii", "3 0 1 2\n1 2 3\n.5 5 6\n-1e0 8 9\n"); }
std::string big_endian_ply_file() {
  return ply_file("binary_big_endian", std::string("\3\0\0\0\1\0\2", 7) + std::string(3 * 14, '\1'));
}

std::string obj_file() { return "v 1 2 3\nv 4 5 6 1\nvn 0 0 1\nv -7 8 .9\nf 1//1 2//1 3//1\nf -1 -2 -3\n"; }
std::string off_file() { return "OFF\n3 1 0\n1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n"; }
std::string ascii_stl_file() {
  return "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid\n";
}
std::string binary_stl_file() {
  return std::string(80, 's') + std::string("\2\0\0\0", 4) + std::string(100, '\1');
}
std::string rows_file() { return "1 2 3 4\n5 6 7 8\n\n9 1e1 -11 12\n"; }
std::string pgm_file() { return "P5\n# depths\n3 2\n65535\n" + std::string(12, '\3'); }
// 4 x 2 grey samples of 16 bits
std::string png_file() {
  constexpr unsigned char bytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
      0x00, 0x00, 0x04, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00, 0x00, 0x00, 0x00, 0x0a, 0x53, 0xfe, 0xfc, 0x00,
      0x00, 0x00, 0x1b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x60, 0x60, 0x7e, 0xc1, 0x7e, 0x81,
      0x7b, 0x07, 0x03, 0xe3, 0x17, 0xc6, 0xaf, 0x8c, 0xdf, 0x18, 0xbf, 0x03, 0x00, 0x2e, 0x15, 0x06, 0x60,
      0x8b, 0x25, 0x05, 0x2b, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {bytes, bytes + sizeof bytes};
}

std::vector<std::string> small_files() {
  return {write_pcd(small_scan()),
          ascii_file(),
          compressed_file(),
          table_file(),
          header + "DATA binary\n" + std::string(6 * 18, '\1'),
          ascii_ply_file(),
          big_endian_ply_file(),
          obj_file(),
          off_file(),
          ascii_stl_file(),
          binary_stl_file(),
          rows_file(),
          pgm_file(),
          png_file()};
}

const ReadOptions as_depths = {.intrinsics = Intrinsics{.fx = 500, .fy = 500, .cx = 2, .cy = 1},
                               .depth_scale = 1000};

// As many as PATCHLAB_MUTATIONS says in all, a share of them for each file; enough for every test run
// otherwise.
int mutations_a_file() {
  const char* const asked = std::getenv("PATCHLAB_MUTATIONS");
  return asked == nullptr ? 2000 : std::max(1, std::atoi(asked) / static_cast<int>(std::size(small_files())));
}

// Bytes, and pieces of text that headers and numbers are made of.
std::string mutated(std::string file, Random& random) {
  const std::string pieces[] = {"-1", "0", "4294967295", "99999999999",       "1e9", " ", "\n", "\r\n", "nan",
                                ",",  "x", "\xFF",       std::string(1, '\0')};
  for (std::size_t change = 0, changes = 1 + random.index(3); change < changes && !file.empty(); ++change) {
    const std::size_t at = random.index(file.size());
    switch (random.index(5)) {
      case 0:
        file[at] = static_cast<char>(random.index(256));
        break;
      case 1:
        file[at] = static_cast<char>(file[at] ^ 1 << random.index(8));
        break;
      case 2:
        file.insert(at, pieces[random.index(std::size(pieces))]);
        break;
      case 3:
        file.erase(at, 1 + random.index(8));
        break;
      case 4:
        file.resize(random.index(4) == 0 ? at : file.size());
        break;
    }
  }
  return file;
}

void expect_whole(const Scan& scan) {
  const std::size_t size = scan.size();
  EXPECT_EQ(std::uint64_t{scan.width} * scan.height, size);
  EXPECT_EQ(scan.finite.size(), size);
  EXPECT_EQ(std::accumulate(scan.finite.begin(), scan.finite.end(), std::size_t{0}), scan.finite_count);
  EXPECT_TRUE(scan.labels.empty() || scan.labels.size() == size);
  EXPECT_TRUE(scan.colours.empty() || scan.colours.size() == size);
  EXPECT_TRUE(scan.covariances.empty() || scan.covariances.size() == size);
  EXPECT_TRUE(rotation(scan.viewpoint).allFinite());
  for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(scan.point(i).allFinite(), scan.finite[i] == 1);
}

class MutationTest : public testing::TestWithParam<std::string> {};

TEST_P(MutationTest, IsRefusedOrWhole) {
  test::SeededRandom random;
  int accepted = 0;
  const int mutations = mutations_a_file();
  for (int i = 0; i < mutations; ++i) {
    const std::string file = mutated(GetParam(), random);
    const Result<Scan> scan = read_scan_bytes(file, "mutated", as_depths);
    if (scan) {
      ++accepted;
      expect_whole(*scan);
    } else {
      EXPECT_EQ(scan.error().code, ErrorCode::unreadable);
      EXPECT_THAT(scan.error().message, testing::StartsWith("mutated: "));
    }
    if (HasFailure()) FAIL() << "mutation " << i << ": " << testing::PrintToString(file);
  }
  EXPECT_GT(accepted, mutations / 500) << "the damage never gets past the header";
}

INSTANTIATE_TEST_SUITE_P(Files, MutationTest, testing::ValuesIn(small_files()));

TEST(Mutation, StartsFromFilesThatAreRead) {
  for (const std::string& file : small_files()) {
    const Result<Scan> scan = read_scan_bytes(file, "whole", as_depths);
    ASSERT_TRUE(scan) << scan.error().message;
    expect_whole(*scan);
  }
}

}  // namespace
}  // namespace patchlab
