// One scene with everything in it, kept as a picture for people to look at.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/random.h"
#include "tests/viewer/render/picture.h"
#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kRadius = 0.06f;   // m, of a ball on a table
constexpr float kOpening = 1.15f;  // rad, of the patch on the ball

Vector3f on_ball(float from_top, float around) {
  return kRadius * Vector3f(std::sin(from_top) * std::cos(around), std::sin(from_top) * std::sin(around),
                            std::cos(from_top));
}

PointsItem table_and_ball(Random& random) {
  std::vector<Vector3f> positions;
  std::vector<Rgba8> colours;
  for (int i = 0; i < 40000; ++i) {
    positions.emplace_back(random.uniform(-0.4, 0.4), random.uniform(-0.3, 0.3),
                           -kRadius + 0.001 * random.normal());
    colours.push_back({136, 142, 155, 255});
  }
  for (int i = 0; i < 4000; ++i) {
    const float from_top = std::acos(1.0f - 1.4f * static_cast<float>(random.uniform()));
    positions.push_back(on_ball(from_top, static_cast<float>(random.uniform(0.0, 2.0 * kPi))) *
                        static_cast<float>(1.0 + 0.01 * random.normal()));
    colours.push_back(from_top < kOpening ? Rgba8{240, 228, 180, 255} : Rgba8{136, 142, 155, 255});
  }
  return {share(std::move(positions)), share(std::move(colours)), 2.5f};
}

// A grid of (rows + 1) x (columns + 1) vertices as triangles.
Shared<std::uint32_t> grid_triangles(std::uint32_t rows, std::uint32_t columns) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
      triangles.insert(triangles.end(), {a, c, b, b, c, d});
    }
  return share(std::move(triangles));
}

MeshItem patch() {
  std::vector<MeshVertex> vertices;
  for (int row = 0; row <= 24; ++row)
    for (int column = 0; column <= 64; ++column) {
      const float part = static_cast<float>(row) / 24.0f;
      const Vector3f point = on_ball(kOpening * part, 2.0f * kPi * static_cast<float>(column) / 64.0f);
      const auto mix = [&](float from, float to) {
        return static_cast<std::uint8_t>(from + part * (to - from));
      };
      vertices.push_back({point, point.normalized(), {mix(49, 94), mix(104, 201), mix(142, 98), 190}});
    }
  return {share(std::move(vertices)), grid_triangles(24, 64), true};
}

MeshItem ellipsoid(const Vector3f& centre, const Vector3f& half_axes) {
  std::vector<MeshVertex> vertices;
  for (int row = 0; row <= 24; ++row)
    for (int column = 0; column <= 48; ++column) {
      const Vector3f unit =
          on_ball(kPi * static_cast<float>(row) / 24.0f, kPi * static_cast<float>(column) / 24.0f) / kRadius;
      vertices.push_back({centre + unit.cwiseProduct(half_axes),
                          unit.cwiseQuotient(half_axes).normalized(),
                          {86, 180, 233, 150}});
    }
  return {share(std::move(vertices)), grid_triangles(24, 48), true};
}

LineItem circle(float from_top, Rgba colour, float width) {
  LineItem line{.colour = colour, .width = width, .closed = true};
  for (int i = 0; i < 96; ++i) line.points.push_back(on_ball(from_top, kPi * static_cast<float>(i) / 48.0f));
  return line;
}

LineItem axis(const Vector3f& direction, Rgba colour) {
  const Vector3f centre = on_ball(0.0f, 0.0f);
  return {.points = {centre, centre + 0.04f * direction},
          .colour = colour,
          .width = 2.5f,
          .on_top = true,
          .hidden_alpha = 0.4f};
}

Scene demo_scene() {
  Random random(3);
  Scene scene;
  scene.background_top = {0.125f, 0.133f, 0.157f, 1.0f};
  scene.background_bottom = {0.075f, 0.078f, 0.086f, 1.0f};
  scene.points = {table_and_ball(random)};
  scene.meshes = {patch(), ellipsoid(on_ball(0.0f, 0.0f), {0.006f, 0.004f, 0.010f})};
  scene.lines = {circle(kOpening, {0.902f, 0.624f, 0.0f, 0.35f}, 9.0f),
                 circle(kOpening, {0.902f, 0.624f, 0.0f, 1.0f}, 2.5f),
                 axis(Vector3f::UnitX(), {0.95f, 0.43f, 0.40f, 1.0f}),
                 axis(Vector3f::UnitY(), {0.50f, 0.85f, 0.45f, 1.0f}),
                 axis(Vector3f::UnitZ(), {0.35f, 0.65f, 1.0f, 1.0f})};
  return scene;
}

ViewCamera demo_camera(int width, int height) {
  OrbitCamera camera;
  camera.elevation = 0.75;
  camera.azimuth = 0.4;
  camera.frame({-0.06, -0.06, -0.06}, {0.06, 0.06, 0.1}, static_cast<double>(width) / height);
  return view_camera(camera, width, height);
}

TEST(Demo, AntialiasingChangesEdgesOnly) {
  constexpr int kWidth = 960, kHeight = 640;
  std::vector<Image> images;
  for (const int samples : {-1, 4}) {
    Studio studio(kWidth, kHeight, samples);
    images.push_back(studio.take(demo_scene(), demo_camera(kWidth, kHeight)));
    keep(samples == 4 ? "demo_multisampled" : "demo", images.back());
  }
  std::size_t different = 0, drawn = 0;
  for (std::size_t i = 0; i < images[0].rgb.size(); ++i) {
    different += std::abs(images[0].rgb[i] - images[1].rgb[i]) > 60;
    drawn += images[0].rgb[i] > 80;
  }
  EXPECT_GT(drawn, images[0].rgb.size() / 10);
  EXPECT_LT(different, images[0].rgb.size() / 50);
}

}  // namespace
}  // namespace patchlab::viewer
