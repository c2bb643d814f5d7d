#include "viewer/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "tests/viewer/render/picture.h"

namespace patchlab::viewer {
namespace {

using Eigen::Vector3f;

constexpr Rgba8 kRed = {255, 0, 0, 255}, kGreen = {0, 255, 0, 255}, kBlue = {0, 0, 255, 255};
constexpr Pixel kRedPixel = {255, 0, 0}, kGreenPixel = {0, 255, 0}, kBluePixel = {0, 0, 255},
                kBlack = {0, 0, 0};

// 200 x 100 pixels: a point (x, y, -1) is at (100 + 50 x, 50 - 50 y). With the samples of PlatformOptions: as
// the platform thinks best (without a GPU the processor draws the points), and multisampled.
class RendererTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (!studio_) renew_studio();
  }
  static void TearDownTestSuite() { studio_.reset(); }
  void renew_studio() {
    studio_.reset();
    studio_ = std::make_unique<Studio>(200, 100, GetParam());
  }
  Image take() { return studio_->take(scene, straight_camera()); }

  Scene scene;
  static inline std::unique_ptr<Studio> studio_;
};
const auto samples_name = [](const auto& samples) { return samples.param < 0 ? "default" : "four"; };
INSTANTIATE_TEST_SUITE_P(AsThePlatformThinksBest, RendererTest, testing::Values(-1), samples_name);
INSTANTIATE_TEST_SUITE_P(Multisampled, RendererTest, testing::Values(4), samples_name);

PointsItem points(std::vector<Vector3f> positions, Rgba8 colour, float size = 6.0f) {
  std::vector<Rgba8> colours(positions.size(), colour);
  return {share(std::move(positions)), share(std::move(colours)), size};
}

// A square of half side `half` that faces the camera, unlit.
MeshItem square(float half, float z, Rgba8 colour) {
  std::vector<MeshVertex> corners;
  for (const Vector3f& corner : {Vector3f(-half, -half, z), Vector3f(half, -half, z), Vector3f(half, half, z),
                                 Vector3f(-half, half, z)})
    corners.push_back({corner, Vector3f::UnitZ(), colour});
  return {share(std::move(corners)), share<std::uint32_t>({0, 1, 2, 0, 2, 3}), false};
}

TEST_P(RendererTest, BackgroundRunsFromTopToBottom) {
  scene.background_top = {1.0f, 0.0f, 0.0f, 1.0f};
  scene.background_bottom = {0.0f, 0.0f, 1.0f, 1.0f};
  const Image image = take();
  EXPECT_GT(at(image, 10, 0).r, 250);
  EXPECT_GT(at(image, 10, 99).b, 250);
  EXPECT_EQ(at(image, 10, 50).r, at(image, 190, 50).r);
}

// What is kept from the last picture is only what has not changed.
TEST_P(RendererTest, WhateverChangesIsDrawnAnew) {
  scene.points = {points({{0.5f, 0.3f, -1.0f}, {-0.5f, 0.1f, -2.0f}}, kRed, 9.0f)};
  ViewCamera camera = straight_camera();
  const std::vector<std::function<void()>> changes = {
      [&] { scene.points[0].colours = share(std::vector<Rgba8>(2, kGreen)); },
      [&] {
        scene.points[0].positions = share<Vector3f>({{0.6f, 0.3f, -1.0f}, {-0.5f, 0.0f, -2.0f}});
      },
      [&] { scene.points[0].size = 15.0f; },
      [&] { scene.points[0].step = 2; },
      [&] {
        scene.points.push_back(points({{0.0f, -0.3f, -2.0f}}, kBlue));
      },
      [&] {
        scene.background_top = {0.2f, 0.3f, 0.4f, 1.0f};
      },
      [&] { scene.fades = false; },
      [&] { camera.position.x() += 0.1; },
      [&] { camera.fov_y *= 0.9; }};
  Image last = studio_->take(scene, camera);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(i);
    changes[i]();
    const Image next = studio_->take(scene, camera), again = studio_->take(scene, camera);
    EXPECT_TRUE(next.rgb != last.rgb);
    EXPECT_TRUE(again.rgb == next.rgb);
    last = next;
    renew_studio();
    EXPECT_TRUE(studio_->take(scene, camera).rgb == next.rgb);
  }
}

TEST_P(RendererTest, PointIsADiskAtItsPixel) {
  scene.points = {points({{0.5f, 0.3f, -1.0f}}, kRed, 13.0f)};
  const Image image = take();
  EXPECT_EQ(at(image, 125, 35), kRedPixel);
  EXPECT_EQ(at(image, 120, 35), kRedPixel);
  EXPECT_EQ(at(image, 119, 29), kBlack) << "the corner of the square around the disk";
  EXPECT_EQ(at(image, 132, 35), kBlack);
}

TEST_P(RendererTest, PointsFollowTheOriginOfTheScene) {
  scene.origin = {1e6, -2e6, 3e6};
  scene.points = {points({{0.5f, 0.3f, -1.0f}}, kRed)};
  ViewCamera camera = straight_camera();
  camera.position = scene.origin;
  EXPECT_EQ(at(studio_->take(scene, camera), 125, 35), kRedPixel);
}

TEST_P(RendererTest, PointsThatAreNotFiniteAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  scene.points = {
      points({{nan, 0.0f, -1.0f}, {0.0f, inf, -1.0f}, {0.0f, 0.0f, nan}, {0.5f, 0.3f, -1.0f}}, kRed)};
  const Image image = take();
  EXPECT_EQ(at(image, 125, 35), kRedPixel);
  EXPECT_EQ(at(image, 100, 50), kBlack);
}

TEST_P(RendererTest, AlphaOfAPointFadesItToTheBackground) {
  scene.background_top = scene.background_bottom = {0.0f, 0.0f, 1.0f, 1.0f};
  scene.points = {points({{0.0f, 0.0f, -1.0f}}, {255, 0, 0, 0}),
                  points({{0.5f, 0.3f, -1.0f}}, {255, 0, 0, 128})};
  const Image image = take();
  EXPECT_EQ(at(image, 100, 50), kBluePixel);
  EXPECT_NEAR(at(image, 125, 35).r, 128, 2);
  EXPECT_NEAR(at(image, 125, 35).b, 127, 2);
}

TEST_P(RendererTest, FarPointsAreFadedButNearOnesKeepTheirColour) {
  scene.points = {points({{-1.0f, 0.0f, -1.0f}, {4.0f, 0.0f, -4.0f}}, kRed)};
  const Image image = take();
  EXPECT_GT(at(image, 50, 50).r, 250);
  EXPECT_LT(at(image, 150, 50).r, 200);
  EXPECT_GT(at(image, 150, 50).r, 120);
}

TEST_P(RendererTest, NewColoursShowAtOnceAndOldPositionsStay) {
  scene.points = {points({{0.0f, 0.0f, -1.0f}}, kRed)};
  take();
  scene.points[0].colours = share<Rgba8>({kGreen});
  EXPECT_EQ(at(take(), 100, 50), kGreenPixel);
}

TEST_P(RendererTest, ArraysThatAreGoneAreNotMistakenForNewOnes) {
  for (int i = 0; i < 50; ++i) {  // an allocator gives the same address again and again
    scene.points.clear();
    scene.points = {
        points({{0.02f * static_cast<float>(i) - 0.5f, 0.0f, -1.0f}}, i % 2 == 0 ? kRed : kGreen)};
    ASSERT_EQ(at(take(), 75 + i, 50), i % 2 == 0 ? kRedPixel : kGreenPixel) << i;
  }
}

TEST_P(RendererTest, EveryStepThPointIsDrawn) {
  scene.points = {
      points({{-1.0f, 0.0f, -1.0f}, {-0.5f, 0.0f, -1.0f}, {0.0f, 0.0f, -1.0f}, {0.5f, 0.0f, -1.0f}}, kRed)};
  scene.points[0].step = 3;
  const Image image = take();
  EXPECT_EQ(at(image, 50, 50), kRedPixel);
  EXPECT_EQ(at(image, 75, 50), kBlack);
  EXPECT_EQ(at(image, 100, 50), kBlack);
  EXPECT_EQ(at(image, 125, 50), kRedPixel);
}

TEST_P(RendererTest, MeshCoversItsPixels) {
  scene.meshes = {square(0.4f, -1.0f, kGreen)};
  const Image image = take();
  EXPECT_EQ(at(image, 81, 31), kGreenPixel);
  EXPECT_EQ(at(image, 118, 68), kGreenPixel);
  EXPECT_EQ(at(image, 78, 50), kBlack);
  EXPECT_EQ(at(image, 100, 28), kBlack);
}

TEST_P(RendererTest, NearerThingsHideFartherOnesInAnyOrder) {
  for (const bool swap : {false, true}) {
    scene.meshes = {square(0.4f, -1.0f, kGreen), square(0.8f, -2.0f, kBlue)};
    if (swap) std::swap(scene.meshes[0], scene.meshes[1]);
    scene.points = {points({{0.0f, 0.0f, -1.5f}}, kRed), points({{0.2f, 0.0f, -0.9f}}, kRed)};
    const Image image = take();
    EXPECT_EQ(at(image, 100, 50), kGreenPixel);
    EXPECT_GT(at(image, 111, 50).r, 250);
  }
}

TEST_P(RendererTest, TranslucentMeshesBlendFromBackToFrontInAnyOrder) {
  for (const bool swap : {false, true}) {
    scene.meshes = {square(0.4f, -1.0f, {0, 255, 0, 128}), square(0.8f, -2.0f, {0, 0, 255, 128}),
                    square(1.5f, -3.0f, kRed)};
    if (swap) std::reverse(scene.meshes.begin(), scene.meshes.end());
    const Pixel pixel = at(take(), 100, 50);
    EXPECT_NEAR(pixel.r, 64, 2);
    EXPECT_NEAR(pixel.g, 128, 2);
    EXPECT_NEAR(pixel.b, 63, 2);
  }
}

TEST_P(RendererTest, LitMeshKeepsItsColourSquareOnAndDarkensAslant) {
  MeshItem facing = square(0.4f, -1.0f, {200, 100, 50, 255});
  facing.lit = true;
  scene.meshes = {facing};
  const Pixel square_on = at(take(), 100, 50);
  EXPECT_NEAR(square_on.r, 200, 6);
  EXPECT_NEAR(square_on.g, 100, 4);

  std::vector<MeshVertex> aslant = *facing.vertices;
  for (MeshVertex& vertex : aslant) vertex.normal = Vector3f(0.0f, -0.9f, 0.44f);
  scene.meshes = {{share(aslant), facing.triangles, true}};
  const Pixel darker = at(take(), 100, 50);
  EXPECT_LT(darker.r, square_on.r - 30);

  for (MeshVertex& vertex : aslant) vertex.normal = -vertex.normal;
  scene.meshes = {{share(aslant), facing.triangles, true}};
  EXPECT_EQ(at(take(), 100, 50), darker) << "both sides are lit alike";
}

TEST_P(RendererTest, LineIsAsWideAsItSays) {
  scene.lines = {
      {.points = {{-1.0f, 0.0f, -1.0f}, {1.0f, 0.0f, -1.0f}}, .colour = {1, 0, 0, 1}, .width = 6.0f}};
  const Image image = take();
  int rows = 0;
  for (int y = 0; y < 100; ++y) rows += at(image, 100, y).r;
  EXPECT_NEAR(rows / 255.0, 6.0, 0.1);
  EXPECT_EQ(at(image, 52, 50), kRedPixel);
  EXPECT_EQ(at(image, 40, 50), kBlack);
  EXPECT_EQ(at(image, 160, 50), kBlack);
}

TEST_P(RendererTest, TranslucentLineIsEvenAcrossItsJoints) {
  LineItem line{.colour = {1, 0, 0, 0.5f}, .width = 10.0f, .closed = true};
  for (int i = 0; i < 40; ++i) {
    const float angle = 0.05f * 3.14159265f * static_cast<float>(i);
    line.points.emplace_back(0.6f * std::cos(angle), 0.6f * std::sin(angle), -1.0f);
  }
  scene.lines = {line};
  const Image image = take();
  int darker = 0, lighter = 0;
  for (int i = 0; i < 400; ++i) {
    const float angle = 0.005f * 3.14159265f * static_cast<float>(i);
    const int red = at(image, static_cast<int>(100.0f + 30.0f * std::cos(angle)),
                       static_cast<int>(50.0f - 30.0f * std::sin(angle)))
                        .r;
    darker += red < 126;
    lighter += red > 130;
  }
  EXPECT_LE(darker, 4);
  EXPECT_LE(lighter, 4);
}

TEST_P(RendererTest, LinesThroughTheEyeAreCutNotFolded) {
  scene.lines = {
      {.points = {{0.5f, 0.0f, 3.0f}, {0.5f, 0.0f, -1.0f}}, .colour = {1, 0, 0, 1}, .width = 4.0f}};
  const Image image = take();
  EXPECT_EQ(at(image, 150, 50), kRedPixel);
  EXPECT_EQ(at(image, 190, 50), kRedPixel);
  EXPECT_EQ(at(image, 50, 50), kBlack);
  EXPECT_EQ(at(image, 110, 50), kBlack);
}

TEST_P(RendererTest, LineOnASurfaceIsWholeAndOneBehindItIsHidden) {
  scene.meshes = {square(0.8f, -1.0f, kBlue)};
  scene.lines = {
      {.points = {{-0.5f, 0.2f, -1.0f}, {0.5f, 0.2f, -1.0f}}, .colour = {1, 0, 0, 1}, .width = 4.0f},
      {.points = {{-0.5f, -0.2f, -1.1f}, {0.5f, -0.2f, -1.1f}}, .colour = {1, 0, 0, 1}, .width = 4.0f}};
  const Image image = take();
  for (int x = 78; x < 122; ++x) EXPECT_EQ(at(image, x, 40), kRedPixel) << x;
  EXPECT_EQ(at(image, 100, 59), kBluePixel);
}

TEST_P(RendererTest, LineIsDimmedBehindATranslucentMeshAndWholeInFrontOfIt) {
  scene.meshes = {square(0.8f, -1.0f, {0, 0, 255, 1})};
  for (const float alpha : {1.0f, 0.5f}) {
    scene.lines = {
        {.points = {{-0.5f, 0.2f, -1.0f}, {0.5f, 0.2f, -1.0f}}, .colour = {1, 0, 0, alpha}, .width = 4.0f},
        {.points = {{-0.5f, -0.2f, -1.1f}, {0.5f, -0.2f, -1.1f}}, .colour = {1, 0, 0, alpha}, .width = 4.0f}};
    const Image image = take();
    EXPECT_NEAR(at(image, 100, 40).r, 255.0f * alpha, 2.0f);
    EXPECT_NEAR(at(image, 100, 59).r, 255.0f * alpha * 0.35f, 3.0f);
  }
}

TEST_P(RendererTest, LineOnTopShowsThroughAndItsHiddenPartIsDimmed) {
  scene.meshes = {square(0.4f, -1.0f, kBlue)};
  LineItem line{.points = {{-1.6f, 0.0f, -2.0f}, {1.6f, 0.0f, -2.0f}}, .colour = {1, 0, 0, 1}, .width = 4.0f};
  line.on_top = true;
  scene.lines = {line};
  EXPECT_EQ(at(take(), 100, 50), kRedPixel);
  scene.lines[0].hidden_alpha = 0.5f;
  const Image image = take();
  EXPECT_NEAR(at(image, 100, 50).r, 128, 2);
  EXPECT_NEAR(at(image, 100, 50).b, 127, 2);
  EXPECT_EQ(at(image, 70, 50), kRedPixel);
}

TEST_P(RendererTest, DrawsInItsViewportOnly) {
  scene.background_top = scene.background_bottom = {0.0f, 0.0f, 1.0f, 1.0f};
  scene.points = {points({{0.0f, 0.0f, -1.0f}}, kRed)};
  scene.lines = {
      {.points = {{-9.0f, 0.0f, -1.0f}, {9.0f, 0.0f, -1.0f}}, .colour = {0, 1, 0, 1}, .width = 4.0f}};
  studio_->platform->begin_frame();
  studio_->renderer->draw(scene, straight_camera(), {100, 20, 80, 60});
  studio_->platform->end_frame();
  const Image image = studio_->platform->read_image();
  EXPECT_EQ(at(image, 99, 50), kBlack);
  EXPECT_EQ(at(image, 180, 50), kBlack);
  EXPECT_EQ(at(image, 140, 19), kBlack);
  EXPECT_EQ(at(image, 140, 80), kBlack);
  EXPECT_EQ(at(image, 100, 20), kBluePixel);
  EXPECT_EQ(at(image, 101, 50), kGreenPixel);
}

TEST_P(RendererTest, IncompleteItemsAreLeftOut) {
  scene.points = {{}, {share<Vector3f>({{0.0f, 0.0f, -1.0f}}), share<Rgba8>({}), 5.0f}};
  scene.meshes = {{}};
  scene.lines = {{}, {.points = {{0.0f, 0.0f, -1.0f}}, .colour = {1, 0, 0, 1}}};
  EXPECT_EQ(at(take(), 100, 50), kBlack);
}

TEST_P(RendererTest, SameSceneTwiceIsTheSamePicture) {
  scene.points = {points({{0.5f, 0.3f, -1.0f}, {0.0f, 0.0f, -2.0f}}, kRed)};
  scene.meshes = {square(0.4f, -1.0f, {0, 255, 0, 90})};
  scene.lines = {
      {.points = {{-1.0f, -0.3f, -1.0f}, {1.0f, 0.4f, -1.0f}}, .colour = {1, 1, 0, 1}, .width = 3.0f}};
  const Image first = take();
  EXPECT_EQ(take().rgb, first.rgb);
  renew_studio();
  EXPECT_EQ(studio_->take(scene, straight_camera()).rgb, first.rgb);
}

}  // namespace
}  // namespace patchlab::viewer
