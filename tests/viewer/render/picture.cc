#include "tests/viewer/render/picture.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <numbers>
#include <ostream>

namespace patchlab::viewer {

Studio::Studio(int width, int height, int samples) {
  Result<std::unique_ptr<Platform>> made =
      make_platform({.width = width, .height = height, .headless = true, .samples = samples});
  if (!made) {
    ADD_FAILURE() << made.error().message;
    return;
  }
  platform = std::move(*made);
  Result<Renderer> created = Renderer::create();
  if (!created) {
    ADD_FAILURE() << created.error().message;
    return;
  }
  renderer.emplace(std::move(*created));
}

Studio::~Studio() { renderer.reset(); }

Image Studio::take(const Scene& scene, const ViewCamera& camera) {
  platform->begin_frame();
  renderer->draw(scene, camera, {0, 0, platform->width(), platform->height()});
  platform->end_frame();
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  return platform->read_image();
}

std::ostream& operator<<(std::ostream& out, const Pixel& pixel) {
  return out << '(' << pixel.r << ' ' << pixel.g << ' ' << pixel.b << ')';
}

Pixel at(const Image& image, int x, int y) {
  const std::size_t i =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

ViewCamera straight_camera() {
  ViewCamera camera;
  camera.fov_y = 0.5 * std::numbers::pi;
  return camera;
}

void keep(const std::string& name, const Image& image) {
  const std::filesystem::path folder = "pictures";
  std::filesystem::create_directories(folder);
  const Result<void> written = write_png(folder / (name + ".png"), image);
  EXPECT_TRUE(written.ok()) << (written.ok() ? "" : written.error().message);
}

}  // namespace patchlab::viewer
