// Pictures of the program at any size, with its panels or of the view alone, on its ground or on none.
#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/app/app.h"

namespace patchlab::viewer {

namespace {

// The same picture on black and on white says how much of the ground shows through each pixel.
Image without_ground(const Image& on_black, const Image& on_white) {
  Image image = on_black;
  image.alpha.resize(image.rgb.size() / 3);
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    int through = 255;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      through = std::min(through, on_white.rgb[k] - on_black.rgb[k]);
    const int alpha = 255 - std::clamp(through, 0, 255);
    image.alpha[i] = static_cast<std::uint8_t>(alpha);
    for (std::size_t k = 3 * i; k < 3 * i + 3 && alpha > 0; ++k) {
      image.rgb[k] = static_cast<std::uint8_t>(std::min(255, on_black.rgb[k] * 255 / alpha));
    }
  }
  return image;
}

}  // namespace

// ImGui lays text out over two frames after a change of size.
Image App::shot(std::optional<Rgba> ground) {
  ground_ = ground;
  frame();
  frame();
  ground_.reset();
  return platform_.read_image();
}

Image App::picture(const PictureOptions& options) {
  const float scale = options.scale > 0 ? options.scale : platform_.scale();
  platform_.set_canvas(Canvas{options.width, options.height, scale});
  picture_ = options;
  const bool transparent = options.view_alone && options.transparent;
  const Image image = transparent ? without_ground(shot(Rgba{0, 0, 0, 1}), shot(Rgba{1, 1, 1, 1})) : shot({});
  picture_.reset();
  platform_.set_canvas(std::nullopt);
  return image;
}

void App::save_picture(const PictureRequest& request) {
  const Rect& view = layout_.view;
  const int width = request.view_alone ? static_cast<int>(view.width) : platform_.width();
  const int height = request.view_alone ? static_cast<int>(view.height) : platform_.height();
  const Image image = picture({width * request.times, height * request.times,
                               platform_.scale() * static_cast<float>(request.times), request.view_alone,
                               request.transparent});
  const Result<void> written = write_png(request.file, image);
  toast(written ? "The picture is in " + request.file.string() + "." : written.error().message, !written);
  if (!written) errors_.push_back(written.error());
}

}  // namespace patchlab::viewer
