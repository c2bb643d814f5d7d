// Collision worlds, read back by the parsers of URDF and by MuJoCo.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <cstring>

#include "engine/base/file.h"
#include "engine/export/triangles.h"
#include "tests/engine/export/consumer.h"
#include "tests/engine/export/ten_types.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

std::string bytes_of(const std::filesystem::path& file) {
  const Result<Bytes> bytes = read_file(file);
  if (bytes) return std::string(as_text(*bytes));
  ADD_FAILURE() << bytes.error().message;
  return {};
}

TEST(Urdf, PlacesEveryPatchAndItsMesh) {
  const test::Folder folder;
  const PatchSet set = test::ten_types();
  const auto world = test::export_to(folder.at("world"), "urdf", set, {.thickness = 0.01});
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(bytes_of(world / "world.urdf"));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->getRoot()->name, "camera");
  for (const PatchRecord& record : set.patches) {
    const urdf::LinkConstSharedPtr link = model->getLink(record.id);
    ASSERT_TRUE(link) << record.id;
    const urdf::Pose& pose = link->parent_joint->parent_to_joint_origin_transform;
    const Eigen::Quaterniond q(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
    EXPECT_LT((q.toRotationMatrix() - axes(record.patch)).norm(), 1e-14) << record.id;
    EXPECT_EQ(Vector3d(pose.position.x, pose.position.y, pose.position.z), centre(record.patch));
    const auto mesh = std::dynamic_pointer_cast<urdf::Mesh>(link->collision->geometry);
    ASSERT_TRUE(mesh);
    const std::string stl = bytes_of(world / mesh->filename);
    const Triangles solid = thick_solid(record.patch, 0.01);
    ASSERT_EQ(stl.size(), 84 + 50 * solid.faces.size());
    for (std::size_t i = 0; i < 3 * solid.faces.size(); ++i) {
      Eigen::Vector3f corner;
      std::memcpy(corner.data(), stl.data() + 84 + 50 * (i / 3) + 12 + 12 * (i % 3), 12);
      ASSERT_EQ(corner, solid.points[solid.faces[i / 3][i % 3]].cast<float>()) << record.id;
    }
  }
}

TEST(Urdf, MarksWhatWouldBeFilledByAHull) {
  const PatchSet set = test::sample_set();
  const Result<Exported> exported = export_patches(**export_format("urdf"), set);
  ASSERT_TRUE(exported);
  const std::string& text = exported->files[0].bytes;
  EXPECT_THAT(text, HasSubstr("<link name=\"sphere_concave\" concave=\"yes\">"));
  EXPECT_THAT(text, HasSubstr("<link name=\"hyperbolic_paraboloid_convex\" concave=\"yes\">"));
  EXPECT_THAT(text, HasSubstr("<link name=\"sphere_convex\">"));
  EXPECT_THAT(text, HasSubstr("<link name=\"plane_circle\">"));
}

TEST(Urdf, IsAcceptedByCheckUrdf) {
  PATCHLAB_NEEDS("check_urdf", "liburdfdom-tools");
  const test::Folder folder;
  PatchSet set = test::ten_types();
  set.patches[0].id = "a & \"b\" <c>";
  const auto world = test::export_to(folder.at("world"), "urdf", set);
  const test::Ran ran = test::run("check_urdf '" + (world / "world.urdf").string() + "'");
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_THAT(ran.output, HasSubstr("root Link: camera has 10 child(ren)"));
  EXPECT_THAT(ran.output, HasSubstr(set.patches[0].id));
}

TEST(Urdf, RefusesAPatchThatHasTheNameOfItsFrame) {
  PatchSet set = test::designed_set();
  set.patches[0].id = set.patches[0].frame_id;
  const Result<Exported> exported = export_patches(**export_format("urdf"), set);
  ASSERT_FALSE(exported);
  EXPECT_EQ(exported.error().code, ErrorCode::refused);
}

TEST(Worlds, OfSeveralFramesAreRefused) {
  PatchSet set = test::ten_types();
  set.patches[3].frame_id = "left_foot";
  for (const char* format : {"urdf", "mjcf"})
    EXPECT_FALSE(export_patches(**export_format(format), set)) << format;
}

}  // namespace
}  // namespace patchlab
