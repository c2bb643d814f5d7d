// Pictures of scenes for tests, drawn without a display.
#pragma once

#include <optional>
#include <string>

#include "viewer/platform/platform.h"
#include "viewer/render/renderer.h"

namespace patchlab::viewer {

// A platform with a renderer; renderer goes first.
struct Studio {
  std::unique_ptr<Platform> platform;
  std::optional<Renderer> renderer;

  // samples as in PlatformOptions.
  Studio(int width, int height, int samples = -1);
  ~Studio();
  Image take(const Scene& scene, const ViewCamera& camera);
};

struct Pixel {
  int r, g, b;
  bool operator==(const Pixel&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Pixel& pixel);
Pixel at(const Image& image, int x, int y);  // from the upper left corner

template <class T>
Shared<T> share(std::vector<T> values) {
  return std::make_shared<const std::vector<T>>(std::move(values));
}

// A camera at the origin of the world looking along -z, x right, y up, where a point (x, y, -1) of the plane
// at depth 1 is at pixel (width / 2 + x * height / 2, height / 2 - y * height / 2).
ViewCamera straight_camera();

// Writes the picture among the outputs of the test, for people to look at.
void keep(const std::string& name, const Image& image);

}  // namespace patchlab::viewer
