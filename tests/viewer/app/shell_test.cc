// What surrounds the work: panels, palette, views, measuring, pictures, and what a file does not say.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/viewer/app/ball_scan.h"
#include "tests/viewer/app/program.h"
#include "viewer/panel/colours.h"
#include "viewer/tool/measure.h"

namespace patchlab::viewer {
namespace {

class ShellTest : public testing::Test {
 protected:
  void open_ball() {
    program_.app().open(folder_.ball());
    program_.settle();
  }
  const ViewState& state() { return program_.app().state(); }
  TestFolder folder_;
  Program program_{folder_.path() / "state", {1.0f, ThemeChoice::dark}};
};

TEST_F(ShellTest, APanelIsDraggedWiderAndItsWidthIsRemembered) {
  program_.settle();
  const Rect edge = program_.app().layout().inspector;
  const std::string y = " " + std::to_string(edge.y + 100) + " ";
  program_.play("drag " + std::to_string(edge.x) + y + std::to_string(edge.x - 40) + y +
                std::to_string(edge.x - 80) + y + "\n");
  EXPECT_EQ(program_.app().layout().inspector.width, edge.width + 80);
  EXPECT_EQ(program_.app().settings().widths.inspector, 364.0f + 80.0f);
  EXPECT_EQ(program_.app().settings().widths.tree, 250.0f);
}

TEST_F(ShellTest, NoButtonOfTheToolBarIsCutHoweverNarrowTheWindow) {
  for (const int width : {1600, 1100, 900, 700}) {
    program_.resize(width, 640);
    program_.settle();
    for (const auto& [name, place] : program_.app().widgets()) {
      if (!name.starts_with("tools/")) continue;
      EXPECT_LE(place.right(), static_cast<float>(width)) << name << " at " << width;
    }
    EXPECT_TRUE(program_.app().widgets().contains("tools/Lasso"));
  }
}

TEST_F(ShellTest, TabGivesTheViewTheRoomOfThePanelsAndBack) {
  program_.play("key Tab\n");
  EXPECT_EQ(program_.app().layout().view.width, program_.app().layout().menu.width);
  program_.play("key Tab\n");
  EXPECT_EQ(program_.app().layout().tree.width, 250.0f);
}

TEST_F(ShellTest, TheContourSurvivesAResize) {
  open_ball();
  program_.play("key L\nclick " + program_.at(-0.05, -0.05) + "\nclick " + program_.at(0.05, -0.05) +
                "\nclick " + program_.at(0.0, 0.05) + "\n");
  program_.resize(1000, 640);
  program_.settle();
  EXPECT_TRUE(state().drawing);
  EXPECT_EQ(state().contour.size(), 3u);
  program_.play("key Enter\nwait\n");
  EXPECT_EQ(program_.app().workbench().session().document().regions.size(), 1u);
}

TEST_F(ShellTest, ARegionAndItsPatchGetAColourByTheirMenuAndLoseItByUndo) {
  open_ball();
  program_.play("key L\n" + program_.draw_circle(0.05) + "wait\nkey Enter\nwait\n");
  ASSERT_EQ(program_.document().patches.size(), 1u);
  const Rect row = program_.app().widgets().at("tree/region-1");
  program_.play("move " + std::to_string(row.x + row.width / 2) + " " +
                std::to_string(row.y + row.height / 2) + "\npress right\nrelease right\nwait\n");
  program_.picture("program_colour_menu");
  program_.play("click tree/colour 4\nwait\n");
  EXPECT_EQ(program_.document().regions.front().colour, okabe_ito[3]);
  EXPECT_EQ(program_.document().patches.front().colour, okabe_ito[3]);
  EXPECT_EQ(colour_of(program_.document().patches.front()), rgba(okabe_ito[3]));
  program_.play("key Ctrl+Z\nwait\n");
  EXPECT_FALSE(program_.document().patches.front().colour);
}

TEST_F(ShellTest, ACommandIsFoundByAPartOfItsNameAndRunByEnter) {
  open_ball();
  program_.play("key Ctrl+P\ntype light\n");
  EXPECT_TRUE(program_.app().widgets().contains("palette/Light theme"));
  EXPECT_FALSE(program_.app().widgets().contains("palette/Undo"));
  program_.picture("program_palette");
  program_.play("key Enter\n");
  EXPECT_EQ(state().theme, ThemeChoice::light);
  EXPECT_FALSE(program_.app().widgets().contains("palette/text"));
  program_.play("key Ctrl+P\ntype points by noise\nkey Enter\nwait\n");
  EXPECT_EQ(state().colours, PointColours::noise) << "the palette opens empty";
  EXPECT_EQ(program_.app().settings().theme, ThemeChoice::light) << "what the window comes back with";
}

// Of the ball before its wall: what a lasso through both takes.
TEST_F(ShellTest, WhatIsNotInTheDepthSlabIsNotSelected) {
  open_ball();
  const std::string round_all = "key L\ndrag " + program_.at(-0.4, -0.4) + " " + program_.at(0.4, -0.4) +
                                " " + program_.at(0.4, 0.4) + " " + program_.at(-0.4, 0.4) + "\nwait\n";
  const auto selected = [this] {
    const std::vector<RegionEntry>& regions = program_.app().workbench().session().document().regions;
    return regions.empty() ? 0 : regions.back().points->size();
  };
  program_.play("key X\n" + round_all);
  const std::size_t all = selected();
  program_.play("key Z\n");
  ASSERT_TRUE(state().slab);
  EXPECT_TRUE(program_.app().widgets().contains("slab/front"));
  program_.play(round_all);
  EXPECT_LT(selected(), all) << "the ball is before the slab";
  EXPECT_GT(selected(), all / 2) << "the wall is in it";
  program_.picture("program_slab");
  program_.play("click slab/close\n");
  EXPECT_FALSE(state().slab);
  program_.play(round_all);
  EXPECT_EQ(selected(), all);
}

TEST_F(ShellTest, NamedViewsLookAlongTheAxes) {
  open_ball();
  program_.play("key 7\nwait\n");
  EXPECT_NEAR(program_.app().camera().elevation, std::numbers::pi / 2, 1e-6);
  program_.play("key Ctrl+8\nwait\n");
  EXPECT_NEAR(std::abs(program_.app().camera().azimuth), std::numbers::pi, 1e-6);
  EXPECT_NEAR(program_.app().camera().elevation, 0.0, 1e-6);
}

TEST_F(ShellTest, TwoClicksMeasureADistanceWithItsSigma) {
  open_ball();
  program_.play("key D\nclick " + program_.at(-0.3, -0.3) + "\n");
  ASSERT_TRUE(state().measured);
  EXPECT_TRUE(state().measured->text.empty());
  program_.play("click " + program_.at(0.3, -0.3) + "\n");
  ASSERT_EQ(state().measured->ends.size(), 2u);
  EXPECT_NE(state().measured->text.find("  ± "), std::string::npos) << state().measured->text;
  program_.picture("program_measured");
  program_.play("key Esc\n");
  EXPECT_FALSE(state().measured);
}

TEST(MeasuredDistance, CarriesTheCovarianceOfItsEndsAlongTheLine) {
  MeasuredPoint one{"scan-1", {0, 0, 0}, Eigen::Matrix3d::Zero()},
      other{"scan-1", {3, 4, 0}, Eigen::Matrix3d::Zero()};
  one.cov(2, 2) = 1.0;  // across: says nothing of the length
  other.cov(0, 0) = 0.25;
  const MeasuredDistance length = distance(one, other);
  EXPECT_DOUBLE_EQ(length.metres, 5.0);
  EXPECT_DOUBLE_EQ(length.sigma, 0.6 * 0.5);
}

TEST_F(ShellTest, APictureHasTheSizeThatIsAskedForAndTheWindowStaysAsItWas) {
  open_ball();
  const Image before = program_.image();
  const Image large = program_.app().picture({2400, 1520, 2.0f, false, false});
  EXPECT_EQ(large.width, 2400);
  EXPECT_EQ(large.rgb.size(), 3u * 2400 * 1520);
  program_.settle();
  EXPECT_EQ(program_.image().rgb, before.rgb);
}

TEST_F(ShellTest, APictureOfTheViewAloneCanBeWithoutAGround) {
  open_ball();
  program_.play("move " + program_.at(0, 0) + "\nwheel -30\nwait\n");
  const Image image = program_.app().picture({300, 200, 1.0f, true, true});
  ASSERT_EQ(image.alpha.size(), 300u * 200u);
  EXPECT_EQ(image.alpha[300 * 10 + 290], 0) << "nothing is seen there";
  EXPECT_EQ(image.alpha[300 * 100 + 150], 255) << "the ball";
}

TEST_F(ShellTest, ThePictureIsSavedByItsDialog) {
  open_ball();
  program_.play("key F12\nclick picture/view\nclick picture/2\n");
  program_.picture("program_save_picture");
  program_.play("click files/confirm\nwait\n");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "ball.png"));
  EXPECT_EQ(state().messages.back().text.substr(0, 15), "The picture is ");
}

TEST_F(ShellTest, ACameraIsAskedForWhereADepthImageNeedsOne) {
  std::string image = "P5\n8 6\n65535\n";
  for (int i = 0; i < 48; ++i) image += std::string("\x03\xe8", 2);
  ASSERT_TRUE(write_file(folder_.path() / "depth.pgm", image).ok());
  program_.app().open(folder_.path() / "depth.pgm");
  program_.settle();
  program_.picture("program_scan_form");
  ASSERT_TRUE(program_.app().widgets().contains("scan form/camera"));
  program_.play("type 10, 10\nkey Enter\n");
  EXPECT_TRUE(program_.document().scans.empty()) << "two numbers are no camera";
  program_.play("type , 3.5, 2.5\nkey Enter\nwait\n");
  ASSERT_EQ(program_.document().scans.size(), 1u);
  EXPECT_EQ(program_.document().scans[0].scan->finite_count, 48u);
  EXPECT_NEAR(program_.document().scans[0].scan->point(0).z(), 1.0, 1e-6);
}

TEST_F(ShellTest, AUnitIsAskedForWhereMetresWouldBeTooLarge) {
  const std::string mesh = "v 0 0 1000\nv 600 0 1000\nv 0 600 1000\nf 1 2 3\n";
  ASSERT_TRUE(write_file(folder_.path() / "part.obj", mesh).ok());
  program_.app().open(folder_.path() / "part.obj");
  program_.settle();
  ASSERT_TRUE(program_.app().widgets().contains("scan form/Millimetre"));
  program_.play("click scan form/open\nwait\n");
  ASSERT_EQ(program_.document().scans.size(), 1u);
  EXPECT_NEAR(bounds(*program_.document().scans[0].scan)->max.x(), 0.6, 1e-6);
  EXPECT_FALSE(program_.app().widgets().contains("scan form/open"));
}

TEST_F(ShellTest, WhatWasSaidIsReadAgain) {
  program_.app().open(folder_.path() / "none.pcd");
  program_.settle();
  program_.play("key Ctrl+P\ntype messages\nkey Enter\n");
  EXPECT_TRUE(program_.app().widgets().contains("messages/close"));
  EXPECT_EQ(state().messages.size(), 1u);
}

// The lasso is exact at every scale of the interface: what is recorded is where the pointer was.
class ScaledShellTest : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(Scales, ScaledShellTest, testing::Values(1.25f, 1.5f), [](const auto& scale) {
  return std::to_string(static_cast<int>(100 * scale.param)) + "Percent";
});

TEST_P(ScaledShellTest, TheRecordedContourIsWhereThePointerWas) {
  const TestFolder folder;
  Program program(folder.path() / "state", {GetParam(), ThemeChoice::dark});
  program.app().open(folder.ball());
  program.settle();
  const Rect view = program.app().layout().view;
  const float x = std::round(view.x + view.width / 2 - 30), y = std::round(view.y + view.height / 2 - 20);
  const auto place = [](float px, float py) { return std::to_string(px) + " " + std::to_string(py); };
  program.play("key L\nclick " + place(x, y) + "\nclick " + place(x + 50, y) + "\nclick " + place(x, y + 50) +
               "\nkey Enter\nwait\n");
  const Result<Bytes> bytes = read_file(program.app().workbench().session().journal());
  ASSERT_TRUE(bytes);
  const Result<std::vector<Command>> commands = read_journal(as_text(*bytes), "journal");
  ASSERT_TRUE(commands);
  const Select* select = std::get_if<Select>(&commands->back());
  ASSERT_NE(select, nullptr);
  EXPECT_NEAR(select->polygon.at(0).x(), x - view.x, 0.02);
  EXPECT_NEAR(select->polygon.at(0).y(), y - view.y, 0.02);
  const RegionEntry& region = program.document().regions.at(0);
  for (const std::uint32_t id : *region.points) {
    const Projected seen = project(select->camera, program.document().scans[0].scan->point(id));
    EXPECT_GT(seen.x, select->polygon[0].x() - 1);
    EXPECT_LT(seen.x - select->polygon[0].x() + seen.y - select->polygon[0].y(), 51);
  }
}

}  // namespace
}  // namespace patchlab::viewer
