#include "viewer/tool/lasso_tool.h"

#include <gtest/gtest.h>

#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {
namespace {

using Eigen::Vector2d;
using Outcome = LassoTool::Outcome;

class LassoToolTest : public testing::Test {
 protected:
  LassoView view() const {
    const ViewCamera camera = view_camera(orbit, 800, 600);
    return {camera, orbit.distance, scale};
  }
  Outcome press(double x, double y, SelectMode mode = SelectMode::set) {
    return tool.press({x, y}, mode, view());
  }
  Outcome move(double x, double y) { return tool.move({x, y}, view()); }
  Outcome release(double x, double y) { return tool.release({x, y}, view()); }
  Outcome click(double x, double y) {
    const Outcome pressed = press(x, y);
    return pressed == Outcome::closed ? pressed : std::max(pressed, release(x, y));
  }
  void drag_square(SelectMode mode = SelectMode::set) {
    press(100, 100, mode);
    for (double x = 100; x <= 300; x += 10) move(x, 100);
    for (double y = 100; y <= 300; y += 10) move(300, y);
    for (double x = 300; x >= 100; x -= 10) move(x, 300);
  }
  std::vector<Vector2d> contour() const { return tool.contour(view().camera); }

  OrbitCamera orbit;
  double scale = 1.0;
  LassoTool tool;
};

TEST_F(LassoToolTest, ADragDrawsFreehandAndItsReleaseCloses) {
  drag_square();
  EXPECT_TRUE(tool.drawing());
  EXPECT_EQ(release(100, 290), Outcome::closed);
  EXPECT_GT(contour().size(), 50u);
  EXPECT_NEAR(contour().front().x(), 100, 1e-6);
  EXPECT_NEAR(contour().front().y(), 100, 1e-6);
}

TEST_F(LassoToolTest, ClicksPlaceCornersAndAClickNearTheStartCloses) {
  EXPECT_EQ(click(100, 100), Outcome::changed);
  EXPECT_EQ(click(300, 100), Outcome::changed);
  EXPECT_EQ(click(300, 300), Outcome::changed);
  EXPECT_TRUE(tool.near_start({104, 104}, view()));
  EXPECT_EQ(click(104, 104), Outcome::closed);
  EXPECT_EQ(contour().size(), 3u);
}

TEST_F(LassoToolTest, TwoCornersNearTheStartDoNotClose) {
  click(100, 100);
  EXPECT_EQ(click(102, 102), Outcome::changed);
  EXPECT_EQ(contour().size(), 2u);
}

TEST_F(LassoToolTest, ADoubleClickAndEnterClose) {
  for (const bool by_enter : {false, true}) {
    tool.reset();
    click(100, 100);
    click(300, 100);
    click(300, 300);
    EXPECT_EQ(by_enter ? tool.enter() : tool.double_click(), Outcome::closed);
  }
}

TEST_F(LassoToolTest, FewerThanThreeCornersCannotClose) {
  click(100, 100);
  click(300, 100);
  EXPECT_EQ(tool.enter(), Outcome::cancelled);
  EXPECT_FALSE(tool.drawing());
}

TEST_F(LassoToolTest, ADragAfterClicksIsPartOfTheSameContour) {
  click(100, 100);
  click(300, 100);
  press(300, 150);
  for (double y = 150; y <= 300; y += 10) move(300, y);
  EXPECT_EQ(release(300, 300), Outcome::changed);
  EXPECT_TRUE(tool.drawing());
  EXPECT_GT(contour().size(), 10u);
}

TEST_F(LassoToolTest, BackspaceTakesTheLastCornerBackAndThenTheContour) {
  click(100, 100);
  click(300, 100);
  EXPECT_EQ(tool.backspace(), Outcome::changed);
  EXPECT_EQ(contour().size(), 1u);
  EXPECT_EQ(tool.backspace(), Outcome::cancelled);
  EXPECT_EQ(tool.backspace(), Outcome::none);
}

TEST_F(LassoToolTest, EscapeDropsTheContour) {
  EXPECT_EQ(tool.escape(), Outcome::none);
  drag_square();
  EXPECT_EQ(tool.escape(), Outcome::cancelled);
  EXPECT_FALSE(tool.drawing());
  EXPECT_EQ(release(100, 290), Outcome::none);
}

TEST_F(LassoToolTest, ThePointerIsTheLastCornerWhileCornersAreBeingPlaced) {
  click(100, 100);
  click(300, 100);
  EXPECT_EQ(move(310, 250), Outcome::changed);
  ASSERT_EQ(contour().size(), 3u);
  EXPECT_NEAR(contour().back().y(), 250, 1e-6);
}

TEST_F(LassoToolTest, TheContourSurvivesNavigationAnchoredInTheWorld) {
  click(100, 100);
  click(300, 100);
  click(300, 300);
  const std::vector<Vector2d> before = contour();
  orbit.orbit(0.4, 0.2);
  const std::vector<Vector2d> turned = contour();
  ASSERT_EQ(turned.size(), before.size());
  EXPECT_GT((turned[0] - before[0]).norm(), 5.0);
  orbit.orbit(-0.4, -0.2);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT((contour()[i] - before[i]).norm(), 0.02);
}

TEST_F(LassoToolTest, AContourDrawnBeforeAPanMovesWithTheScene) {
  click(100, 100);
  orbit.pan({50, -20}, 600);
  EXPECT_LT((contour().front() - Vector2d(150, 80)).norm(), 0.01);
}

TEST_F(LassoToolTest, TheContourIsInHundredthsOfAPixelSoThatAJournalReadsWell) {
  click(100.123456, 200.98765);
  EXPECT_EQ(contour().front(), Vector2d(100.12, 200.99));
}

TEST_F(LassoToolTest, VerticesBehindTheCameraAreLeftOut) {
  click(400, 300);
  orbit.pivot += 5 * orbit.distance * (orbit.pivot - view().camera.position).normalized();
  EXPECT_TRUE(contour().empty());
}

TEST_F(LassoToolTest, ThresholdsGrowWithTheScale) {
  scale = 2.0;
  press(100, 100);
  EXPECT_EQ(move(108, 100), Outcome::none);
  EXPECT_EQ(release(108, 100), Outcome::none);
  EXPECT_TRUE(tool.drawing());
  tool.reset();
  scale = 1.0;
  press(100, 100);
  EXPECT_EQ(move(108, 100), Outcome::changed);
}

TEST_F(LassoToolTest, TheModeIsTheOneOfTheFirstPress) {
  press(100, 100, SelectMode::subtract);
  release(100, 100);
  press(300, 100, SelectMode::add);
  EXPECT_EQ(tool.mode(), SelectMode::subtract);
}

TEST(LassoMode, ModifiersOverruleTheToolBar) {
  EXPECT_EQ(mode_of({}, SelectMode::intersect), SelectMode::intersect);
  EXPECT_EQ(mode_of({.shift = true}, SelectMode::set), SelectMode::add);
  EXPECT_EQ(mode_of({.ctrl = true}, SelectMode::set), SelectMode::subtract);
  EXPECT_EQ(mode_of({.shift = true, .ctrl = true}, SelectMode::add), SelectMode::intersect);
}

TEST(Unproject, IsTheInverseOfProject) {
  OrbitCamera orbit;
  for (const bool perspective : {true, false}) {
    orbit.perspective = perspective;
    const ViewCamera camera = view_camera(orbit, 800, 600);
    const double depth = project(camera, orbit.pivot).depth;
    const Projected seen = project(camera, unproject(camera, {123, 456}, 0.7 * depth));
    EXPECT_NEAR(seen.x, 123, 1e-6);
    EXPECT_NEAR(seen.y, 456, 1e-6);
    EXPECT_NEAR(seen.depth, 0.7 * depth, 1e-9);
  }
}

TEST(RectangleTool, SpansFromCornerToCornerWhicheverWayItIsDragged) {
  LassoView view;
  view.camera.viewport = {800, 600};
  LassoTool tool;
  EXPECT_EQ(tool.press({300, 200}, SelectMode::add, view, ContourShape::rectangle),
            LassoTool::Outcome::changed);
  EXPECT_EQ(tool.move({250, 320}, view), LassoTool::Outcome::changed);
  EXPECT_EQ(tool.move({100, 350}, view), LassoTool::Outcome::changed);
  EXPECT_EQ(tool.release({100, 350}, view), LassoTool::Outcome::closed);
  EXPECT_EQ(tool.mode(), SelectMode::add);
  const std::vector<Eigen::Vector2d> contour = tool.contour(view.camera);
  ASSERT_EQ(contour.size(), 4u);
  EXPECT_LT((contour[0] - Eigen::Vector2d(300, 200)).norm(), 0.01);
  EXPECT_LT((contour[1] - Eigen::Vector2d(100, 200)).norm(), 0.01);
  EXPECT_LT((contour[2] - Eigen::Vector2d(100, 350)).norm(), 0.01);
  EXPECT_LT((contour[3] - Eigen::Vector2d(300, 350)).norm(), 0.01);
}

TEST(RectangleTool, AClickIsNoRectangle) {
  LassoView view;
  LassoTool tool;
  tool.press({300, 200}, SelectMode::set, view, ContourShape::rectangle);
  EXPECT_EQ(tool.release({302, 201}, view), LassoTool::Outcome::cancelled);
  EXPECT_FALSE(tool.drawing());
}

TEST(RectangleTool, IsForgottenWithItsContour) {
  LassoView view;
  LassoTool tool;
  tool.press({300, 200}, SelectMode::set, view, ContourShape::rectangle);
  tool.escape();
  tool.press({300, 200}, SelectMode::set, view);
  EXPECT_EQ(tool.release({300, 200}, view), LassoTool::Outcome::none) << "a corner of a polygon";
  EXPECT_TRUE(tool.drawing());
}

}  // namespace
}  // namespace patchlab::viewer
