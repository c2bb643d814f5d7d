// Files without a header, recognised by what their numbers can be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::string records(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

const std::vector<float> kitti = {10.F, -2.F, 0.5F, 0.25F, 20.F, 3.F, -1.5F, 0.F};
const std::vector<float> nuscenes = {10.F, -2.F, 0.5F, 12.F, 31.F, 20.F, 3.F, -1.5F, 0.F, 0.F};

TEST(Kitti, PointsLieAboutTheSensor) {
  const Result<Scan> scan = read_scan_bytes(records(kitti), "000001.bin");
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->format, "kitti");
  EXPECT_EQ(scan->size(), 2u);
  EXPECT_EQ(scan->point(1), Eigen::Vector3d(20, 3, -1.5));
  EXPECT_EQ(scan->intensities, (std::vector<float>{0.25F, 0.F}));
  EXPECT_TRUE(scan->viewpoint.stated);
  EXPECT_TRUE(rotation(scan->viewpoint).col(2).isApprox(Eigen::Vector3d::UnitX())) << "forward is +x";
  EXPECT_TRUE(rotation(scan->viewpoint).col(1).isApprox(-Eigen::Vector3d::UnitZ())) << "down is -z";
}

TEST(Kitti, FifthNumberIsTheLaserOfNuScenes) {
  const Result<Scan> scan = read_scan_bytes(records(nuscenes), "LIDAR_TOP.pcd.bin");
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->size(), 2u);
  EXPECT_EQ(scan->fields.size(), 5u);
  EXPECT_THAT(scan->notices, Contains(HasSubstr("nuScenes")));
}

TEST(Kitti, OtherBytesAreNotGuessedAt) {
  std::vector<float> far = kitti;
  far[0] = 1e6F;
  for (const std::string& bytes : {records(far), records(kitti).substr(1), std::string(64, '\0')}) {
    EXPECT_FALSE(read_scan_bytes(bytes, "a.bin"));
  }
  EXPECT_FALSE(read_scan_bytes(records(kitti), "a.dat"));
}

}  // namespace
}  // namespace patchlab
