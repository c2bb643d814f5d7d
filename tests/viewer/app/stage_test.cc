#include "viewer/app/stage.h"

#include <gtest/gtest.h>

#include <limits>

#include "viewer/app/boxes.h"
#include "viewer/app/point_shades.h"
#include "viewer/panel/colours.h"

namespace patchlab::viewer {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::shared_ptr<Scan> scan_of(std::vector<Eigen::Vector3f> points,
                              const Eigen::Vector3d& origin = {0, 0, 0}) {
  auto scan = std::make_shared<Scan>();
  scan->origin = origin;
  scan->positions = std::move(points);
  for (const Eigen::Vector3f& p : scan->positions) {
    scan->finite.push_back(p.allFinite());
    scan->finite_count += p.allFinite();
  }
  return scan;
}

class StageTest : public testing::Test {
 protected:
  StageTest() {
    ScanEntry entry;
    entry.id = "scan-1";
    entry.scan = scan_of({{0, 0, 1}, {0.1f, 0, 1}, {0.2f, 0, 1}, {0.3f, 0, 1}});
    document.scans.push_back(entry);
    add_region("region-1", {0, 1});
    add_region("region-2", {2});
  }
  void add_region(const std::string& id, std::vector<std::uint32_t> points) {
    document.regions.push_back(
        {id, id, "scan-1", std::make_shared<const std::vector<std::uint32_t>>(points), true});
  }
  void add_sphere() {
    const PatchTypeRow& type = *find_patch_type(SurfaceType::sphere, BoundaryType::circle);
    FitResult fit;
    fit.patch = make_patch(type, {BoundaryType::circle, BoundaryVector::Constant(1, 0.05)},
                           Eigen::VectorXd::Constant(1, -10.0), Eigen::Matrix3d::Identity(), {0, 0, 1},
                           PatchMatrix(PatchMatrix::Identity(7, 7) * 1e-8));
    fit.report.residuals = {2.0, -2.0};
    fit.report.outliers = {1};
    PatchEntry entry;
    entry.id = entry.name = "patch-1";
    entry.scan = "scan-1";
    entry.region = "region-1";
    entry.fit = std::make_shared<const FitResult>(fit);
    entry.points = document.regions[0].points;
    document.patches.push_back(entry);
  }
  void update() { stage.update(document, state, ++generation, 1.0f); }
  // Colour of a point of the scan's own item.
  Rgba8 colour(std::size_t point) { return (*stage.scene().points.at(0).colours)[point]; }

  Document document;
  ViewState state;
  Stage stage;
  std::uint64_t generation = 0;
};

TEST_F(StageTest, TheChosenRegionIsLitAndOthersAreTinted) {
  state.selected = "region-1";
  update();
  const Rgba8 lit = to_bytes(theme(state.theme).point_selected);
  EXPECT_EQ(colour(0), lit);
  EXPECT_EQ(colour(1), lit);
  EXPECT_NE(colour(2), lit);
  EXPECT_NE(colour(2), colour(3));
}

TEST_F(StageTest, AHiddenScanIsNotDrawnAndAHiddenPatchNeither) {
  add_sphere();
  update();
  EXPECT_EQ(stage.scene().points.size(), 1u);
  EXPECT_FALSE(stage.scene().meshes.empty());
  document.scans[0].visible = document.patches[0].visible = false;
  update();
  EXPECT_TRUE(stage.scene().points.empty());
  EXPECT_TRUE(stage.scene().meshes.empty());
}

TEST_F(StageTest, ThePointsOfTheChosenPatchAreDrawnApartAndOutliersFlagged) {
  add_sphere();
  state.selected = "patch-1";
  update();
  ASSERT_EQ(stage.scene().points.size(), 2u);
  EXPECT_EQ(colour(0)[3], 0);
  EXPECT_EQ(colour(1), to_bytes(theme(state.theme).point_outlier));
  const std::vector<Rgba8>& own = *stage.scene().points[1].colours;
  EXPECT_EQ(own[0], to_bytes(theme(state.theme).point_selected));
}

TEST_F(StageTest, ResidualsAreBlueBelowAndOrangeAbove) {
  add_sphere();
  document.patches[0].fit = std::make_shared<const FitResult>([this] {
    FitResult fit = *document.patches[0].fit;
    fit.report.outliers.clear();
    return fit;
  }());
  state.selected = "patch-1";
  state.colours = PointColours::residual;
  update();
  const std::vector<Rgba8>& own = *stage.scene().points.at(1).colours;
  EXPECT_GT(own[0][0], own[0][2]);
  EXPECT_GT(own[1][2], own[1][0]);
}

TEST_F(StageTest, TheChosenPatchSaysWithWhatProbabilityAndHowMuchLarger) {
  add_sphere();
  state.selected = "patch-1";
  update();
  const SceneNotes notes = stage.notes(view_camera(stage.camera, 800, 600));
  ASSERT_EQ(notes.lines.size(), 3u);
  EXPECT_EQ(notes.lines[0], "95 % ellipsoid of the centre, drawn 20 times larger");
  EXPECT_NE(notes.lines[1].find("95 % cone of the normal"), std::string::npos);
  ASSERT_TRUE(notes.height_sigma);
  EXPECT_GT(notes.height_sigma->y(), notes.height_sigma->x());
  EXPECT_EQ(notes.labels.size(), 3u);
}

TEST_F(StageTest, LayersThatAreOffAreNotDrawnAndNotSpokenOf) {
  add_sphere();
  state.selected = "patch-1";
  state.layers = {false, false, false, false, false};
  update();
  EXPECT_TRUE(stage.scene().meshes.empty());
  EXPECT_EQ(stage.scene().lines.size(), 1u);  // the outline
  EXPECT_TRUE(stage.notes(view_camera(stage.camera, 800, 600)).lines.empty());
}

TEST_F(StageTest, TheSameStateKeepsTheSameArrays) {
  update();
  const auto before = stage.scene().points[0].colours;
  stage.update(document, state, generation, 1.0f);
  EXPECT_EQ(stage.scene().points[0].colours, before);
  state.selected = "region-1";
  stage.update(document, state, generation, 1.0f);
  EXPECT_NE(stage.scene().points[0].colours, before);
}

TEST_F(StageTest, ScansFarFromTheOriginKeepTheirPrecision) {
  document.scans[0].scan = scan_of({{0, 0, 1}, {0.001f, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {5e6, 4e5, 100});
  ScanEntry other;
  other.id = "scan-2";
  other.scan = scan_of({{0, 0, 0}}, {5e6 + 1, 4e5, 100});
  document.scans.push_back(other);
  update();
  EXPECT_EQ(stage.scene().origin.x(), 5e6);
  EXPECT_EQ((*stage.scene().points[0].positions)[1].x(), 0.001f);
  EXPECT_EQ((*stage.scene().points[1].positions)[0].x(), 1.0f);
}

TEST_F(StageTest, FramingShowsTheChosenThingAndAFlightEndsThere) {
  add_sphere();
  stage.frame(document, "patch-1", 1.3);
  EXPECT_TRUE(stage.fly(0.01));
  stage.settle();
  EXPECT_LT((stage.camera.pivot - Eigen::Vector3d(0, 0, 1)).norm(), 0.05);
  EXPECT_FALSE(stage.fly(0.01));
}

TEST(TurnTowards, PutsTheEyeInThatDirection) {
  OrbitCamera camera;
  camera.up = Eigen::Vector3d(0.1, -1, 0.2).normalized();
  for (const Eigen::Vector3d& wanted :
       {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-1, 0.2, 0.5), Eigen::Vector3d(0, 0, -1)}) {
    turn_towards(camera, wanted);
    const Eigen::Vector3d eye = view_camera(camera, 8, 6).position - camera.pivot;
    EXPECT_LT((eye.normalized() - wanted.normalized()).norm(), 1e-9);
  }
}

TEST(DepthSeenBySensor, IsTheMedianAndNothingWhereTheSensorStoodAmongThePoints) {
  EXPECT_EQ(depth_seen_by_sensor(*scan_of({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, nan}})), 2.0);
  EXPECT_EQ(depth_seen_by_sensor(*scan_of({{0, 0, 1}, {0, 0, -2}, {0, 0, 3}})), std::nullopt);
  EXPECT_EQ(depth_seen_by_sensor(*scan_of({})), std::nullopt);
}

TEST(PointShades, AreDarkerFurtherAwayAndZeroWhereNothingIs) {
  const auto scan = scan_of({{0, 0, 1}, {0.01f, 0, 2}, {0, 0, nan}});
  const std::vector<std::uint8_t> shades = point_shades(*scan, 0);
  EXPECT_GT(shades[0], shades[1]);
  EXPECT_EQ(shades[2], 0);
}

TEST(PointShades, OfAPixelGridShowWhichWayASurfaceFaces) {
  auto roof = scan_of({});
  roof->width = 40;
  roof->height = 20;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      const float u = 0.01f * static_cast<float>(x - 20);
      roof->positions.emplace_back(u, 0.01f * static_cast<float>(y - 10), 1.0f + std::abs(u));
      roof->finite.push_back(1);
    }
  }
  roof->finite_count = roof->positions.size();
  const std::vector<std::uint8_t> shades = point_shades(*roof);
  // The light stands to the left of the sensor: the left side of the roof is the brighter one.
  EXPECT_GT(shades[10 * 40 + 8], shades[10 * 40 + 32] + 20);
}

TEST_F(StageTest, PointsAreColouredByTheirHeightAlongTheAxisOfTheTurntable) {
  stage.camera.up = Eigen::Vector3d::UnitX();
  document.regions.clear();
  state.colours = PointColours::height;
  update();
  EXPECT_EQ(colour(0), to_bytes(sequential(0.0)));
  EXPECT_EQ(colour(3), to_bytes(sequential(1.0)));
  const auto bar = stage.notes(ViewCamera{}).points;
  ASSERT_TRUE(bar);
  EXPECT_STREQ(bar->title, "height, m");
  EXPECT_NEAR(bar->range.x(), 0.0, 1e-6);
  EXPECT_NEAR(bar->range.y(), 0.3, 1e-6);
}

TEST_F(StageTest, PointsAreColouredByTheirIntensityAndPlainWhereThereIsNone) {
  document.regions.clear();
  update();
  const Rgba8 plain = colour(0);
  state.colours = PointColours::intensity;
  update();
  EXPECT_EQ(colour(0), plain);
  EXPECT_FALSE(stage.notes(ViewCamera{}).points);
  auto scan = std::make_shared<Scan>(*document.scans[0].scan);
  scan->intensities = {10, 40, 20, 30};
  document.scans[0].scan = scan;
  ++generation;
  update();
  EXPECT_EQ(colour(0), to_bytes(sequential(0.0)));
  EXPECT_EQ(colour(1), to_bytes(sequential(1.0)));
  EXPECT_STREQ(stage.notes(ViewCamera{}).points->title, "intensity");
}

TEST_F(StageTest, PointsAreColouredByTheirNoiseOnceItIsKnown) {
  document.regions.clear();
  state.colours = PointColours::noise;
  update();
  EXPECT_FALSE(stage.notes(ViewCamera{}).points);
  ScanEntry& entry = document.scans[0];
  entry.noise = *noise_model("isotropic:0.002");
  stage.set_sigmas(entry, noise_sigmas(*entry.scan, entry.noise));
  update();
  const auto bar = stage.notes(ViewCamera{}).points;
  ASSERT_TRUE(bar);
  EXPECT_STREQ(bar->title, "noise σ, mm");
  EXPECT_NEAR(bar->range.x(), 2.0, 1e-4);
}

TEST_F(StageTest, WhileTheCameraMovesFewerPointsAreDrawn) {
  update();
  stage.size_points(600, 2.0f);
  EXPECT_EQ(stage.scene().points[0].step, 1u);
  EXPECT_EQ(stage.points(), 4u);
  stage.size_points(600, 2.0f, 7);
  EXPECT_EQ(stage.scene().points[0].step, 7u);
  stage.size_points(600, 2.0f);
  EXPECT_EQ(stage.scene().points[0].step, 1u) << "all of them when it stands still";
}

TEST_F(StageTest, ShapeAndPoseAreDrawnApart) {
  add_sphere();
  const Patch& patch = document.patches[0].fit->patch;
  const Patch shape = with_part(patch, SigmaOf::shape), pose = with_part(patch, SigmaOf::pose);
  const auto n = patch.type->rotation_at();
  EXPECT_TRUE(shape.covariance_local->bottomRightCorner(5, 5).isZero(0));
  EXPECT_EQ(shape.covariance_local->topLeftCorner(n, n), patch.covariance_local->topLeftCorner(n, n));
  EXPECT_TRUE(pose.covariance_local->topLeftCorner(n, n).isZero(0));
  EXPECT_EQ(pose.covariance_local->bottomRightCorner(5, 5), patch.covariance_local->bottomRightCorner(5, 5));
  state.selected = "patch-1";
  state.sigma_of = SigmaOf::pose;
  update();
  EXPECT_NE(stage.notes(ViewCamera{}).lines.back().find("pose alone"), std::string::npos);
}

TEST_F(StageTest, EllipsoidsOfPointsSayHowManyAndHowMuchLarger) {
  add_sphere();
  document.scans[0].noise = *noise_model("isotropic:0.002");
  state.selected = "patch-1";
  state.layers.points = true;
  update();
  EXPECT_TRUE(stage.notes(ViewCamera{}).lines.back().starts_with("95 % ellipsoids of "));
}

TEST_F(StageTest, PointsAreColouredByTheirLabelsAndPlainWhereThereIsNone) {
  auto scan = std::make_shared<Scan>(*document.scans[0].scan);
  scan->labels = {0, 7, 7, 2};
  document.scans[0].scan = scan;
  document.regions.clear();
  update();
  const Rgba8 plain = colour(0);
  state.colours = PointColours::label;
  update();
  EXPECT_EQ(colour(0), plain);
  EXPECT_EQ(colour(1), to_bytes(category_colour("label-7")));
  EXPECT_EQ(colour(1), colour(2));
  EXPECT_NE(colour(1), colour(3));
}

}  // namespace
}  // namespace patchlab::viewer
