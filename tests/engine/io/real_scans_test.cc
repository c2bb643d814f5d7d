// Scans that nobody here made, read to the counts that other programs found in them
// (../shared/scans/SOURCES.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct RealScan {
  const char* file;
  std::size_t points, finite;
  bool organized;
};

void PrintTo(const RealScan& scan, std::ostream* out) { *out << scan.file; }

constexpr RealScan real_scans[] = {
    {"gicp_source.ply", 69792, 69792, false},
    {"gpd_krylon.pcd", 4467, 4467, false},
    {"gpd_table_mug.pcd", 104444, 104444, false},
    {"gridmap_input_cloud.pcd", 56423, 56423, false},
    {"lpm_car_cloud400.csv", 24989, 24989, false},
    {"mosd_learn0.pcd", 307200, 182292, true},
    {"mosd_learn20.pcd", 307200, 194137, true},
    {"mosd_learn33.pcd", 307200, 179131, true},
    {"mosd_learn36.pcd", 307200, 171863, true},
    {"pcl_bunny.pcd", 397, 397, false},
    {"pcl_colored_cloud.pcd", 1000, 1000, false},
    {"pcl_five_people.pcd", 307200, 239075, true},
    {"pcl_lamppost.pcd", 1771, 1771, false},
    {"pcl_milk_cartoon_all_small_clorox.pcd", 307200, 241407, true},
    {"pcl_office1.pcd", 307200, 254456, true},
    {"pcl_rs1.pcd", 289541, 289541, false},
    {"pcl_table_scene_mug_stereo_textured.pcd", 307200, 209280, true},
    {"pcldata_capture0001.pcd", 307200, 249647, true},
    {"pcldata_region_growing_tutorial.pcd", 108104, 108104, false},
    {"pcldata_room_scan1.pcd", 112586, 112586, false},
    {"pcldata_samp11-utm.pcd", 38010, 38010, false},
    {"planeseg_stair06.pcd", 107772, 107772, false},
    {"planeseg_terrain_med.pcd", 68913, 68913, false},
    {"pythonpcl_flydracyl.pcd", 6731, 6731, false},
    {"slambook_ch5_depth1.pgm", 307200, 209236, true},
    {"slambook_ch5_depth3.pgm", 307200, 223149, true},
    {"sustech_000950.pcd", 68242, 68242, false},
    {"tsdf_frame-000150.depth.png", 307200, 270326, true},
    {"ycb_Banana.obj", 7866, 7866, false},
    {"ycb_CrackerBox.obj", 7866, 7866, false},
    {"ycb_MasterChefCan.obj", 7678, 7678, false},
    {"ycb_MustardBottle.obj", 7866, 7866, false},
};

const std::filesystem::path folder = PATCHLAB_SOURCE_DIR "/../shared/scans";

// Depth images of millimetres; other scans leave the camera aside.
const ReadOptions kinect = {.intrinsics = Intrinsics{.fx = 585, .fy = 585, .cx = 320, .cy = 240},
                            .depth_scale = 1000};

Scan read(const char* file) {
  Result<Scan> scan = read_scan(folder / file, kinect);
  if (!scan) ADD_FAILURE() << scan.error().message;
  return scan ? *std::move(scan) : Scan{};
}

class RealScanTest : public testing::TestWithParam<RealScan> {
 protected:
  void SetUp() override {
    if (!exists(folder / GetParam().file)) GTEST_SKIP() << "the shared scans are not here";
  }
};

TEST_P(RealScanTest, HoldsAsManyPointsAsOthersCounted) {
  const Scan scan = read(GetParam().file);
  EXPECT_EQ(scan.size(), GetParam().points);
  EXPECT_EQ(scan.finite_count, GetParam().finite);
  EXPECT_EQ(scan.organized(), GetParam().organized);
  EXPECT_EQ(std::uint64_t{scan.width} * scan.height, scan.size());
}

INSTANTIATE_TEST_SUITE_P(Shared, RealScanTest, testing::ValuesIn(real_scans), [](const auto& scan) {
  std::string name = scan.param.file;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

class RealTrapTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!exists(folder)) GTEST_SKIP() << "the shared scans are not here";
  }
};

TEST_F(RealTrapTest, WrittenScansReadBackTheSame) {
  for (const char* file : {"pcl_bunny.pcd", "pcl_colored_cloud.pcd", "pcldata_samp11-utm.pcd",
                           "gridmap_input_cloud.pcd", "lpm_car_cloud400.csv"}) {
    const Scan scan = read(file);
    const Result<Scan> again = read_pcd(write_pcd(scan), "written");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->origin, scan.origin) << file;
    EXPECT_EQ(again->positions, scan.positions) << file;
    EXPECT_EQ(again->colours, scan.colours) << file;
    EXPECT_EQ(again->viewpoint.quaternion_xyzw, scan.viewpoint.quaternion_xyzw) << file;
    EXPECT_EQ(again->viewpoint.position, scan.viewpoint.position) << file;
  }
}

TEST_F(RealTrapTest, ViewpointIsTurnedFromWFirstToXyzw) {
  const Scan mug = read("pcl_table_scene_mug_stereo_textured.pcd");
  EXPECT_TRUE(mug.viewpoint.stated);
  EXPECT_EQ(mug.viewpoint.quaternion_xyzw, (std::array<double, 4>{1, 0, 0, 0}));
  EXPECT_FALSE(read("mosd_learn0.pcd").viewpoint.stated);
}

TEST_F(RealTrapTest, MapCoordinatesKeepEveryBitAboutALocalOrigin) {
  const Scan scan = read("pcldata_samp11-utm.pcd");
  EXPECT_GT(scan.origin.y(), 5.4e6);
  const std::optional<Bounds> box = bounds(scan);
  ASSERT_TRUE(box);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3d point = scan.point(i);
    ASSERT_EQ(point, point.cast<float>().cast<double>()) << i;  // the file holds float32
    ASSERT_LT(scan.positions[i].norm(), 2.0 * (box->max - box->min).norm());
  }
}

TEST_F(RealTrapTest, FirstPointOnTheDataLineIsNotLost) {
  const Scan scan = read("pythonpcl_flydracyl.pcd");
  EXPECT_EQ(scan.positions[0], Eigen::Vector3f(-1.722589F, -0.143634F, -0.216288F));
  EXPECT_THAT(scan.notices, Contains(HasSubstr("DATA line")));
}

TEST_F(RealTrapTest, BytesAfterTheLastPointAreNoted) {
  EXPECT_THAT(read("sustech_000950.pcd").notices,
              Contains(HasSubstr("3848 zero bytes (padding) after the last point")));
}

TEST_F(RealTrapTest, FilesBesideADepthImageAreRefusedInOneSentence) {
  for (const auto& [file, what] :
       {std::pair{"tsdf_camera-intrinsics.txt", "give it as --intrinsics"},
        std::pair{"tsdf_frame-000150.pose.txt", "the pose of a camera"},
        std::pair{"tsdf_frame-000150.color.png", "is a colour picture of 8 bits"}}) {
    const Result<Scan> scan = read_scan(folder / file, kinect);
    ASSERT_FALSE(scan) << file;
    EXPECT_THAT(scan.error().message, HasSubstr(what));
  }
}

TEST_F(RealTrapTest, MillimetresAreSuspected) {
  EXPECT_THAT(read("pcldata_region_growing_tutorial.pcd").notices, Contains(HasSubstr("millimetres")));
  EXPECT_THAT(read("pcldata_samp11-utm.pcd").notices, Not(Contains(HasSubstr("millimetres"))));
}

TEST_F(RealTrapTest, LabelledScanHoldsTheTwoMugs) {
  const Scan scan = read("mosd_learn33.pcd");
  EXPECT_GT(std::ranges::count(scan.labels, 50U), 1000);
  EXPECT_GT(std::ranges::count(scan.labels, 61U), 1000);
}

}  // namespace
}  // namespace patchlab
