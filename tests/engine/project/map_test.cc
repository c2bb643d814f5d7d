// Maps, robots and frames in a document: opened, moved, merged, undone and replayed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/io/map_set.h"
#include "engine/io/patch_set.h"
#include "engine/project/placed.h"
#include "engine/project/session.h"
#include "tests/engine/project/scan_folder.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

constexpr const char* slider_urdf = R"(<robot name="slider">
  <link name="base"><visual><geometry><box size="0.2 0.1 0.1"/></geometry></visual></link>
  <link name="arm"><collision><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.02" length="0.2"/></geometry></collision></link>
  <joint name="reach" type="prismatic"><parent link="base"/><child link="arm"/><axis xyz="1 0 0"/>
    <limit lower="0.1" upper="0.5" effort="1" velocity="1"/></joint>
</robot>)";
constexpr const char* slider_patches =
    R"({"format": "patchlab.robot_patches", "version": 1, "urdf": "slider.urdf",
  "patches": [{"id": "palm", "link": "arm", "surface": "plane", "boundary": "circle",
    "parameters": {"names": ["d", "r_x", "r_y", "c_x", "c_y", "c_z"], "values": [0.05, 0, 0, 0, 0, 0.2]},
    "covariance": null}]})";

// A level disc of radius 0.1 m at x with 1 mm and 1 mrad of noise.
PatchRecord disc(const std::string& id, const std::string& source, double x, double z) {
  PatchRecord record;
  record.id = record.name = id;
  record.source = source;
  record.frame_id = "world";
  const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::circle);
  PatchMatrix covariance = PatchMatrix::Identity(type.size(), type.size()) * 1e-6;
  record.patch = make_patch(type, Boundary{BoundaryType::circle, BoundaryVector::Constant(1, 0.1)},
                            Eigen::VectorXd(), Matrix3d::Identity(), {x, 0.0, z}, covariance);
  return record;
}

class MapDocument : public ScanFolder {
 protected:
  MapDocument() {
    write("slider.urdf", slider_urdf);
    write("slider.patches.json", slider_patches);
    write_set("a.json", "scan-a", {{0.0, 0.0}, {1.0, 0.0}});
    write_set("b.json", "scan-b", {{0.0, 0.0005}, {1.0, -0.0005}, {2.0, 0.0}});
  }
  struct Spot {
    double x, z;
  };
  void write_set(const std::string& file, const std::string& source, const std::vector<Spot>& spots) const {
    PatchSet set;
    set.sources.push_back({source, source + ".pcd", std::string(64, 'a') + source, "kinect1", false, {}});
    for (const Spot& spot : spots)
      set.patches.push_back(disc(source + "-" + std::to_string(set.patches.size()), source, spot.x, spot.z));
    write(file, *write_patch_set(set));
  }
  static OpenRobot open_slider() {
    return {.id = "robot-1", .file = "slider.urdf", .patches = "slider.patches.json"};
  }
  static OpenMap open_map(const std::string& id, const std::string& file) { return {.id = id, .file = file}; }
  static std::vector<Command> two_maps() {
    return {open_map("map-1", "a.json"), open_map("map-2", "b.json")};
  }
  std::string refusal(const Document& before, Command command) const {
    const Result<Document> document = apply(before, command, here());
    return document ? "accepted" : document.error().message;
  }
};

TEST_F(MapDocument, ARobotStartsAtTheEndOfItsLimitsThatIsNearestToZero) {
  const Document document = after({open_slider()});
  ASSERT_EQ(document.robots.size(), 1u);
  EXPECT_EQ(document.robots[0].name, "slider");
  EXPECT_EQ(document.robots[0].frame, "base");
  EXPECT_EQ(document.robots[0].joints.at("reach").value, 0.1);
}

TEST_F(MapDocument, LinksLookAsTheUrdfSaysAndByWhatTheyCollideWithWhereItDoesNot) {
  const Document document = after({open_slider()});
  const std::vector<LinkShape>& shapes = document.robots[0].model->robot.shapes;
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].kind, LinkShapeKind::box);
  EXPECT_EQ(shapes[0].size, Vector3d(0.2, 0.1, 0.1));
  EXPECT_EQ(shapes[1].kind, LinkShapeKind::cylinder);
  EXPECT_EQ(shapes[1].link_from_shape.t, Vector3d(0, 0, 0.1));
}

TEST_F(MapDocument, AJointMovesThePatchesBehindItAndItsSigmaWidensThem) {
  const Document document = after({open_slider(), SetJoint{"robot-1", "reach", 0.4, 0.01}});
  const auto placed = find_placed(document, "robot-1/palm");
  ASSERT_TRUE(placed);
  const Result<Patch> palm = as_shown(document, *placed);
  ASSERT_TRUE(palm);
  EXPECT_NEAR(centre(*palm).x(), 0.4, 1e-12);
  const PatchMatrix& cov = *palm->covariance_local;
  EXPECT_NEAR((std::sqrt(cov.bottomRightCorner<3, 3>().trace())), 0.01, 1e-9);
}

TEST_F(MapDocument, WrongJointsAndRobotsAreNamed) {
  const Document document = after({open_slider()});
  EXPECT_THAT(refusal(document, SetJoint{"robot-1", "elbow", 0.0, {}}), HasSubstr("elbow"));
  EXPECT_THAT(refusal(document, SetJoint{"robot-2", "reach", 0.0, {}}), HasSubstr("robot-2"));
  EXPECT_THAT(refusal(document, open_slider()), HasSubstr("taken"));
  OpenRobot other = open_slider();
  other.id = "robot-2";
  other.sha256 = "5f0c";
  EXPECT_THAT(refusal(document, other), HasSubstr("not the file that was recorded"));
}

TEST_F(MapDocument, ARobotStandsWhereItsFrameIsPlaced) {
  UncertainPose pose;
  pose.pose.t = {1.0, 2.0, 3.0};
  pose.covariance.diagonal().tail<3>().setConstant(1e-4);
  const Document document = after({open_map("map-1", "a.json"), open_slider(), Place{"base", "world", pose}});
  const Result<Patch> palm = as_shown(document, *find_placed(document, "robot-1/palm"));
  ASSERT_TRUE(palm);
  EXPECT_TRUE(centre(*palm).isApprox(Vector3d(1.1, 2.0, 3.2), 1e-12));
  EXPECT_NEAR((palm->covariance_local->bottomRightCorner<3, 3>().trace()), 3e-4, 1e-12);
  EXPECT_THAT(refusal(document, Place{"world", "base", {}}), HasSubstr("loop"));
}

TEST_F(MapDocument, WhatTwoPatchesOfARobotShareDropsOutBetweenThem) {
  UncertainPose pose;
  pose.covariance.setIdentity();
  const Document document = after({open_map("map-1", "a.json"), open_slider(), Place{"base", "world", pose}});
  const Result<Relation> self = relate(document, "robot-1/palm", "robot-1/palm");
  ASSERT_TRUE(self);
  EXPECT_EQ(self->distance.sigma, 0.0);
  const Result<Relation> far = relate(document, "robot-1/palm", "map-1/scan-a-0");
  ASSERT_TRUE(far);
  EXPECT_GT(far->distance.sigma, 0.9);
}

TEST_F(MapDocument, NothingIsAskedAcrossFramesThatAreNotJoined) {
  const Document document = after({open_map("map-1", "a.json"), open_slider()});
  const Result<Relation> relation = relate(document, "robot-1/palm", "map-1/scan-a-0");
  ASSERT_FALSE(relation);
  EXPECT_THAT(relation.error().message, HasSubstr("place one in the other"));
}

TEST_F(MapDocument, AMergeFusesWhatBothSeeAndAddsTheRest) {
  std::vector<Command> commands = two_maps();
  commands.push_back(Merge{"map-1", "map-2", 0.95, {}});
  const Document document = after(commands);
  ASSERT_EQ(document.maps.size(), 1u);
  const std::vector<MapPatch>& patches = document.maps[0].map->patches;
  ASSERT_EQ(patches.size(), 3u);
  EXPECT_EQ(patches[0].observations.size(), 2u);
  EXPECT_NEAR(centre(patches[0].patch).z(), 0.00025, 1e-7);
  EXPECT_EQ(patches[2].observations.size(), 1u);
}

TEST_F(MapDocument, ARefusedPairStaysApart) {
  std::vector<Command> commands = two_maps();
  commands.push_back(Merge{"map-1", "map-2", 0.95, {{"scan-a-1", "scan-b-1"}}});
  const Document document = after(commands);
  const std::vector<MapPatch>& patches = document.maps[0].map->patches;
  ASSERT_EQ(patches.size(), 4u);
  EXPECT_EQ(patches[0].observations.size(), 2u);
  EXPECT_EQ(patches[1].observations.size(), 1u);
  const Document before = after(two_maps());
  EXPECT_THAT(refusal(before, Merge{"map-1", "map-2", 0.95, {{"scan-a-0", "scan-b-1"}}}),
              HasSubstr("no match"));
}

TEST_F(MapDocument, ASightCountsOnce) {
  std::vector<Command> commands = two_maps();
  commands.push_back(Merge{"map-1", "map-2", 0.95, {}});
  commands.push_back(open_map("map-3", "b.json"));
  EXPECT_THAT(refusal(after(commands), Merge{"map-1", "map-3", 0.95, {}}), HasSubstr("counts once"));
}

TEST_F(MapDocument, TheFittedPatchesOfAScanBecomeAMap) {
  const Document document = after({open_boxes(), select_label("region-1", 7),
                                   fit_plane("patch-1", "region-1"), Merge{"", "scan-1", 0.95, {}}});
  ASSERT_EQ(document.maps.size(), 1u);
  EXPECT_EQ(document.maps[0].id, "map-1");
  const PatchVector& fitted = document.patches[0].fit->patch.parameters;
  EXPECT_TRUE(document.maps[0].map->patches[0].patch.parameters.isApprox(fitted, 1e-12));
  EXPECT_EQ(set_to_export(document, "map-1/patch-1", "").patches.size(), 1u);
}

TEST_F(MapDocument, UndoBringsBackWhatWasMergedAndReplayMakesTheSameMap) {
  Result<Session> session = Session::open(at("work.patchlab"));
  ASSERT_TRUE(session) << session.error().message;
  Session& open = *session;
  std::vector<Command> commands = two_maps();
  commands.push_back(open_slider());
  commands.push_back(SetJoint{"robot-1", "reach", 0.3, 0.002});
  commands.push_back(Merge{"map-1", "map-2", 0.9, {{"scan-a-1", "scan-b-1"}}});
  for (const Command& command : commands) {
    const Result<void> done = open.run(command);
    ASSERT_TRUE(done) << done.error().message;
  }
  const std::string merged = *write_patch_set(*open.document().maps[0].set);
  ASSERT_TRUE(open.run(Undo{}));
  EXPECT_EQ(open.document().maps.size(), 2u);
  ASSERT_TRUE(open.run(Redo{}));
  const Result<Document> again = replay(at("work.patchlab"));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*write_patch_set(*again->maps[0].set), merged);
  EXPECT_EQ(again->robots[0].joints.at("reach").value, 0.3);
  EXPECT_THAT(text("work.patchlab"), HasSubstr("sha256"));
}

TEST_F(MapDocument, AMapGoesOnFromItsFile) {
  std::vector<Command> commands = two_maps();
  commands.push_back(Merge{"map-1", "map-2", 0.95, {}});
  write("m.json", *write_patch_set(*after(commands).maps[0].set));
  const Document document = after({open_map("map-1", "m.json")});
  EXPECT_EQ(document.maps[0].map->patches[0].observations.size(), 2u);
}

}  // namespace
}  // namespace patchlab
