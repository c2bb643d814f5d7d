// Maps and robots in the window: opened by their file, moved by sliders, placed, merged and asked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "engine/base/file.h"
#include "engine/io/patch_set.h"
#include "tests/viewer/app/ball_scan.h"
#include "tests/viewer/app/program.h"

namespace patchlab::viewer {
namespace {

const std::filesystem::path assets = PATCHLAB_SOURCE_DIR "/assets";

class MapView : public testing::TestWithParam<Look> {
 protected:
  void open_walker() {
    program_.app().open(assets / "walker.urdf");
    program_.settle();
  }
  // Two sights of the same three level discs, 0.4 mm apart.
  void open_two_maps() {
    for (const auto& [name, height] : {std::pair{"first", 0.0}, std::pair{"second", 0.0004}}) {
      PatchSet set;
      set.sources.push_back(
          {name, std::string(name) + ".pcd", std::string(64, name[0]), "kinect1", false, {}});
      for (int i = 0; i < 3; ++i) set.patches.push_back(disc(name, i, height));
      const std::filesystem::path file = folder_.path() / (std::string(name) + ".json");
      ASSERT_TRUE(write_file(file, *write_patch_set(set)));
      program_.app().open(file);
      program_.settle();
    }
  }
  static PatchRecord disc(const std::string& source, int number, double height) {
    PatchRecord record;
    record.id = record.name = source + " " + std::to_string(number);
    record.source = source;
    record.frame_id = "world";
    const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::circle);
    record.patch = make_patch(type, {BoundaryType::circle, BoundaryVector::Constant(1, 0.1)},
                              Eigen::VectorXd(), Eigen::Matrix3d::Identity(), {0.3 * number, 0.0, height},
                              PatchMatrix(PatchMatrix::Identity(type.size(), type.size()) * 1e-6));
    return record;
  }
  Rect widget(const std::string& name) {
    const auto found = program_.app().widgets().find(name);
    EXPECT_NE(found, program_.app().widgets().end()) << name;
    return found == program_.app().widgets().end() ? Rect{} : found->second;
  }
  // Along a slider, from a part of its width to others.
  std::string drag_along(const std::string& name, std::initializer_list<float> parts) {
    const Rect rect = widget(name);
    std::string log = "drag";
    for (const float part : parts)
      log +=
          " " + std::to_string(rect.x + part * rect.width) + " " + std::to_string(rect.y + rect.height / 2);
    return log + "\n";
  }
  const Session& session() { return program_.app().workbench().session(); }

  TestFolder folder_;
  Program program_{folder_.path() / "state", GetParam(), 1200, 900};
};

INSTANTIATE_TEST_SUITE_P(Looks, MapView,
                         testing::Values(Look{1.0f, ThemeChoice::dark}, Look{2.0f, ThemeChoice::light}),
                         [](const auto& look) { return look.index == 0 ? "dark" : "light_twice_as_large"; });

std::string name_of(const std::string& what, const Look& look) {
  return what + (look.theme == ThemeChoice::dark ? "_dark" : "_light_twice_as_large");
}

TEST_P(MapView, ARobotOpensWithWhatLiesBesideItAndAJointIsOneStepOfTheHistory) {
  open_walker();
  ASSERT_EQ(program_.document().robots.size(), 1u);
  EXPECT_EQ(program_.document().robots[0].model->patches.size(), 6u);
  EXPECT_EQ(program_.document().robots[0].joints.at("left_knee").value, 0.95);
  const std::size_t steps = session().position();
  program_.play(drag_along("joints/left_hip_roll", {0.5f, 0.6f, 0.7f, 0.8f}));
  EXPECT_EQ(session().position(), steps + 1);
  const double rolled = session().document().robots[0].joints.at("left_hip_roll").value;
  EXPECT_NEAR(rolled, 0.36, 0.05);
  EXPECT_EQ(session().document().robots[0].joints.at("left_hip_roll").sigma, 0.002);
  program_.picture(name_of("program_robot", GetParam()));
  program_.play("key Ctrl+Z\nwait\n");
  EXPECT_EQ(session().document().robots[0].joints.at("left_hip_roll").value, 0.0);
}

TEST_P(MapView, WhileASliderIsHeldTheRobotMovesAndNothingIsRecorded) {
  open_walker();
  const std::size_t steps = session().position();
  const Rect rect = widget("joints/left_hip_yaw");
  const std::string y = " " + std::to_string(rect.y + rect.height / 2) + "\n";
  const std::string from = "move " + std::to_string(rect.x + 0.5f * rect.width) + y;
  program_.play(from + "press left\nmove " + std::to_string(rect.x + 0.9f * rect.width) + y);
  EXPECT_GT(program_.document().robots[0].joints.at("left_hip_yaw").value, 0.5);
  EXPECT_EQ(session().document().robots[0].joints.at("left_hip_yaw").value, 0.0);
  EXPECT_EQ(session().position(), steps);
  program_.play("release left\nwait\n");
  EXPECT_EQ(session().position(), steps + 1);
}

TEST_P(MapView, MatchesAreListedOneIsRefusedTheRestMergedAndUndone) {
  open_two_maps();
  program_.play("click tree/first.json\nclick map/with map-2\nwait\n");
  ASSERT_TRUE(program_.app().state().proposed.matches);
  EXPECT_EQ(program_.app().state().proposed.matches->found.matches.size(), 3u);
  program_.play("click matches/first 1 = second 1\n");
  program_.picture(name_of("program_matches", GetParam()));
  program_.play("click map/merge\nwait\n");
  ASSERT_EQ(session().document().maps.size(), 1u);
  EXPECT_EQ(session().document().maps[0].map->patches.size(), 4u);
  const std::string merged = *write_patch_set(*session().document().maps[0].set);
  const Result<Document> again = replay(session().journal());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*write_patch_set(*again->maps[0].set), merged);
  program_.play("key Ctrl+Z\nwait\n");
  EXPECT_EQ(session().document().maps.size(), 2u);
}

TEST_P(MapView, AFrameIsPlacedByTypingAndTheChosenPatchIsHeldAgainstAnother) {
  open_two_maps();
  open_walker();
  EXPECT_THAT(program_.app().widgets(), testing::Contains(testing::Key("place/z")));
  program_.play("click place/z\ntype 0.854\nkey Enter\nwait\n");
  ASSERT_EQ(session().document().frames.size(), 1u);
  EXPECT_NEAR(session().document().frames[0].pose.pose.t.z(), 0.854, 1e-12);
  program_.play("click tree/left_sole\nclick questions/against\nclick questions/first 0\nwait\n");
  const Questions& asked = program_.app().state().questions;
  ASSERT_TRUE(asked.relation) << asked.message;
  EXPECT_NEAR(asked.relation->foot.gap.value, 0.064, 0.01);
  EXPECT_GT(asked.relation->foot.gap.sigma, 0.0);
  ASSERT_TRUE(asked.slope);
  EXPECT_NEAR(asked.slope->tilt.value, std::numbers::pi, 0.01) << "a sole looks down";
  program_.picture(name_of("program_questions", GetParam()));
}

}  // namespace
}  // namespace patchlab::viewer
