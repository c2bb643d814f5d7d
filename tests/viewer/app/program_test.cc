// The whole program without a display: real panels, real input, real pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

#include "engine/patch/patch.h"
#include "tests/viewer/app/ball_scan.h"
#include "tests/viewer/app/program.h"

namespace patchlab::viewer {
namespace {

// The ball is 60 mm at 0.74 m before a camera that sees 240 pixels of 1 / 262.5: it fills 0.082 of the height
// each side.
constexpr double well_inside = 0.062;

class ProgramTest : public testing::TestWithParam<Look> {
 protected:
  ProgramTest() {
    program_.app().open(folder_.ball());
    program_.settle();
  }
  TestFolder folder_;
  Program program_{folder_.path() / "state", GetParam()};
};
INSTANTIATE_TEST_SUITE_P(ScalesAndThemes, ProgramTest,
                         testing::Values(Look{1.0f, ThemeChoice::dark}, Look{2.0f, ThemeChoice::light}),
                         [](const auto& look) {
                           return look.param.scale == 1.0f ? "Dark" : "LightTwiceAsLarge";
                         });

TEST_P(ProgramTest, FourActionsMakeAKeptSphere) {
  program_.play("key L\n" + program_.draw_circle(well_inside) + "wait\nkey 3\nwait\nkey Enter\n");
  ASSERT_EQ(program_.document().patches.size(), 1u);
  const Patch& patch = program_.document().patches[0].fit->patch;
  EXPECT_EQ(patch.type->surface, SurfaceType::sphere);
  EXPECT_NEAR(1 / std::abs(curvatures(patch)[0]), ball_radius, 0.01);
  EXPECT_TRUE(program_.app().state().draft.empty());
  EXPECT_EQ(program_.app().state().selected, "patch-1");
  EXPECT_TRUE(program_.app().errors().empty());
  program_.picture("program_sphere_" + std::to_string(static_cast<int>(GetParam().scale)));
}

TEST_P(ProgramTest, ThePatchFollowsWhileTheLassoMoves) {
  program_.play("key L\nmove " + program_.at(0, -0.05) + "\npress left\nmove " + program_.at(0.05, 0.03) +
                "\nmove " + program_.at(-0.05, 0.03) + "\nwait\n");
  EXPECT_TRUE(program_.app().state().drawing);
  EXPECT_EQ(program_.app().state().currency, Currency::current);
  EXPECT_EQ(program_.document().patches.size(), 1u);
  EXPECT_TRUE(program_.app().workbench().session().document().regions.empty());
  program_.picture("program_live_" + std::to_string(static_cast<int>(GetParam().scale)));
  program_.play("key Esc\n");
  EXPECT_FALSE(program_.app().state().drawing);
  EXPECT_TRUE(program_.document().patches.empty());
}

TEST_P(ProgramTest, ButtonsOfTheToolBarDoWhatTheySay) {
  program_.play("click tools/Lasso\n");
  EXPECT_EQ(program_.app().state().tool, Tool::lasso);
  program_.play("click tools/Sub\n");
  EXPECT_EQ(program_.app().state().mode, SelectMode::subtract);
  program_.play("click tools/Cylinder\n");
  EXPECT_EQ(program_.app().state().surface, SurfaceRequest::circular_cylinder);
  program_.play("click tools/Reject outliers\n");
  EXPECT_FALSE(program_.app().state().robust);
  program_.play("click tools/Orbit\n");
  EXPECT_EQ(program_.app().state().tool, Tool::orbit);
}

TEST_P(ProgramTest, EscapeCancelsTheContourThenTheFitThenTheTool) {
  program_.play("key L\n" + program_.draw_circle(well_inside) + "wait\n");
  EXPECT_FALSE(program_.app().state().draft.empty());
  program_.play("click " + program_.at(-0.3, -0.3) + "\n");
  EXPECT_TRUE(program_.app().state().drawing);
  program_.play("key Esc\n");
  EXPECT_FALSE(program_.app().state().drawing);
  EXPECT_EQ(program_.app().state().tool, Tool::lasso);
  program_.play("key Esc\n");
  EXPECT_TRUE(program_.app().state().draft.empty());
  program_.play("key Esc\n");
  EXPECT_EQ(program_.app().state().tool, Tool::orbit);
}

TEST_P(ProgramTest, NavigationDuringALassoKeepsTheContour) {
  program_.play("key L\nclick " + program_.at(-0.05, -0.05) + "\nclick " + program_.at(0.05, -0.05) +
                "\nclick " + program_.at(0.05, 0.05) + "\n");
  const OrbitCamera before = program_.app().camera();
  program_.play("move " + program_.at(-0.3, -0.2) + "\npress right\nmove " + program_.at(-0.2, -0.15) +
                "\nrelease right\nmove " + program_.at(0, 0.1) + "\nwheel 2\n");
  EXPECT_NE(program_.app().camera().azimuth, before.azimuth);
  EXPECT_LT(program_.app().camera().distance, before.distance);
  EXPECT_TRUE(program_.app().state().drawing);
  EXPECT_EQ(program_.app().state().contour.size(), 4u);
  program_.play("key Enter\nwait\n");
  EXPECT_EQ(program_.app().workbench().session().document().regions.size(), 1u);
}

TEST_P(ProgramTest, ARectangleSelectsAndTheBasisIsStated) {
  program_.play("click tools/Rect\ndrag " + program_.at(-0.045, -0.045) + program_.at(0.02, 0.01) +
                program_.at(0.045, 0.045) + "\nwait\n");
  const auto command_line = [this] {
    return as_text(*read_file(program_.app().workbench().session().journal()))
        .ends_with("\"visible_only\":true}\n");
  };
  ASSERT_EQ(program_.document().regions.size(), 1u);
  EXPECT_TRUE(command_line());
  program_.play("key X\ndrag " + program_.at(-0.02, -0.04) + program_.at(0.02, 0.01) +
                program_.at(0.04, 0.04) + "\nwait\n");
  EXPECT_FALSE(program_.app().state().visible_only);
  EXPECT_FALSE(command_line());
}

TEST_P(ProgramTest, OneClickOnASurfaceMakesAPatch) {
  program_.play("key G\nkey 3\nclick " + program_.at(0.01, 0.01) + "\nwait\nkey Enter\nwait\n");
  ASSERT_EQ(program_.document().patches.size(), 1u);
  EXPECT_NEAR(1 / std::abs(curvatures(program_.document().patches[0].fit->patch)[0]), ball_radius, 0.005);
  program_.play("key =\nwait\nkey -\nwait\nkey Enter\nwait\nkey H\nwait\n");
  EXPECT_FALSE(program_.document().patches.at(0).visible && program_.document().regions.at(0).visible);
  program_.play("key Shift+H\nwait\nkey S\nwait\n");
  EXPECT_TRUE(program_.document().patches.at(0).visible && program_.document().regions.at(0).visible);
  EXPECT_TRUE(program_.app().errors().empty());
  program_.picture("program_surface_" + std::to_string(static_cast<int>(GetParam().scale)));
}

TEST_P(ProgramTest, AnotherNoiseModelIsChosenFromTheListWhileTheFitFollows) {
  program_.play("key L\n" + program_.draw_circle(well_inside) + "wait\nkey 3\nwait\nkey Enter\nwait\n");
  const auto noise = [this] { return program_.document().scans.at(0).noise.specification; };
  program_.play("key N\nclick noise/isotropic, 5 mm\nwait\n");
  EXPECT_EQ(noise(), "isotropic:0.005");
  EXPECT_TRUE(program_.app().widgets().contains("noise/kinect2")) << "the list stays";
  program_.picture("program_noise_" + std::to_string(static_cast<int>(GetParam().scale)));
  program_.play(
      "click noise/specification\ntype stereo:f=525,baseline=0.075,pointing=0.35,disparity=0.5\n"
      "key Enter\nwait\nkey Esc\n");
  EXPECT_TRUE(noise().ends_with("disparity=0.5")) << noise();
  EXPECT_FALSE(program_.app().widgets().contains("noise/kinect2"));
  program_.play("key Ctrl+Z\nkey Ctrl+Z\nwait\n");
  EXPECT_EQ(noise(), "kinect1");
  EXPECT_TRUE(program_.app().errors().empty());
}

TEST_P(ProgramTest, UndoAndRedoByKey) {
  program_.play("key L\n" + program_.draw_circle(well_inside) + "wait\nkey 3\nkey Enter\nwait\n");
  program_.play("key Ctrl+Z\nkey Ctrl+Z\nwait\n");
  EXPECT_TRUE(program_.document().patches.empty());
  EXPECT_TRUE(program_.document().regions.empty());
  program_.play("key Ctrl+Shift+Z\nkey Ctrl+Shift+Z\nwait\n");
  EXPECT_EQ(program_.document().patches.size(), 1u);
}

TEST_P(ProgramTest, ThePatchIsRenamedInTheTreeAndDeletedByKey) {
  program_.play("key L\n" + program_.draw_circle(well_inside) + "wait\nkey 3\nkey Enter\nwait\n");
  program_.play("click tree/patch-1\nkey F2\n");
  program_.play("type ball front\nkey Enter\n");
  EXPECT_EQ(program_.document().patches.at(0).name, "ball front");
  program_.play("click tree/region-1\nclick tree/ball front\nkey Delete\n");
  EXPECT_TRUE(program_.document().patches.empty());
}

TEST_P(ProgramTest, TheHelpSheetListsTheKeysAndCloses) {
  program_.play("key F1\n");
  program_.picture("program_help_" + std::to_string(static_cast<int>(GetParam().scale)));
  EXPECT_TRUE(program_.app().widgets().contains("help/close"));
  program_.play("type lasso\n");
  program_.play("key Esc\n");
  EXPECT_FALSE(program_.app().widgets().contains("help/close"));
  EXPECT_EQ(program_.app().state().tool, Tool::orbit);
}

TEST_P(ProgramTest, TheFileDialogOpensAScanByKeyboardAlone) {
  program_.play("key Ctrl+O\n");
  program_.picture("program_files_" + std::to_string(static_cast<int>(GetParam().scale)));
  EXPECT_TRUE(program_.app().widgets().contains("files/ball.pcd"));
  program_.play("type ball.p\nkey Enter\nwait\n");
  EXPECT_EQ(program_.document().scans.size(), 2u);
}

TEST_P(ProgramTest, ThePatchesAreExportedByTheDialog) {
  program_.play("key L\n" + program_.draw_circle(well_inside) + "wait\nkey 3\nkey Enter\nwait\nkey Ctrl+E\n");
  program_.play("click format/ply\nclick files/confirm\nwait\n");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "ball.ply"));
}

TEST_P(ProgramTest, EveryActionOfTheTableLeavesTheProgramOnItsFeet) {
  program_.play("key L\n" + program_.draw_circle(well_inside) + "wait\nkey 3\nkey Enter\nwait\n");
  for (const char* key :
       {"F", "V", "Home", "5", "C", "C", "]", "[", "R", "1", "2", "4", "0", "Ctrl+T", "Ctrl+T"}) {
    program_.play(std::string("key ") + key + "\nwait\n");
  }
  EXPECT_TRUE(program_.app().errors().empty());
}

TEST_P(ProgramTest, ThePictureShowsTheScanInTheViewAndTextInThePanels) {
  const Image picture =
      program_.picture("program_scan_" + std::to_string(static_cast<int>(GetParam().scale)));
  const auto colours_in = [&picture](const Rect& rect) {
    std::set<std::array<std::uint8_t, 3>> colours;
    for (int y = static_cast<int>(rect.y); y < static_cast<int>(rect.bottom()); ++y) {
      for (int x = static_cast<int>(rect.x); x < static_cast<int>(rect.right()); ++x) {
        const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                    static_cast<std::size_t>(x));
        colours.insert({picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]});
      }
    }
    return colours.size();
  };
  const Layout& layout = program_.app().layout();
  for (const Rect& rect : {layout.menu, layout.tools, layout.tree, layout.inspector, layout.status}) {
    EXPECT_GT(colours_in(rect), 8u);
  }
  EXPECT_GT(colours_in(layout.view), 50u);
}

TEST(EmptyProgram, GreetsAndOffersToOpenAScan) {
  const TestFolder folder;
  Program program(folder.path(), {1.0f, ThemeChoice::dark});
  program.settle();
  EXPECT_TRUE(program.app().widgets().contains("inspector/open"));
  program.play("key L\nclick 600 400\nclick 700 400\nclick 700 500\nkey Enter\n");
  EXPECT_EQ(program.app().state().toasts.size(), 1u);
  EXPECT_TRUE(program.app().errors().empty());
  program.picture("program_empty");
}

TEST(EmptyProgram, OffersToGoOnWithEarlierWork) {
  const TestFolder folder;
  const std::filesystem::path state = folder.path() / "state";
  const auto work = [&folder, &state] {
    Workbench bench({state, true}, [] {});
    bench.open(folder.ball());
    bench.run(Rename{"scan-1", "the ball"});
    while (!bench.idle()) {
      bench.deliver();
      std::this_thread::yield();
    }
    return bench.take_notices();
  };
  const auto told = [](const std::vector<std::string>& notices) {
    return std::any_of(notices.begin(), notices.end(), [](const std::string& notice) {
      return notice.starts_with("There is earlier work on ball (2 steps");
    });
  };
  EXPECT_FALSE(told(work()));
  EXPECT_TRUE(told(work()));
  Program program(state, {1.0f, ThemeChoice::dark});
  program.settle();
  ASSERT_EQ(program.app().state().earlier.size(), 2u);
  program.picture("program_earlier");
  program.play("click earlier/ball\nwait\n");
  ASSERT_EQ(program.document().scans.size(), 1u);
  EXPECT_EQ(program.document().scans[0].name, "the ball");
  EXPECT_EQ(program.app().state().earlier.size(), 1u) << "what is open is not offered";
}

}  // namespace
}  // namespace patchlab::viewer
