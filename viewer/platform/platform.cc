#include "viewer/platform/platform.h"

#include <png.h>

#include "engine/base/file.h"
#include "viewer/platform/make_platform.h"

namespace patchlab::viewer {

Result<std::unique_ptr<Platform>> make_platform(const PlatformOptions& options) {
  return options.headless ? make_headless_platform(options) : make_window_platform(options);
}

namespace {

std::vector<std::uint8_t> with_alpha(const Image& image) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    rgba.insert(rgba.end(), {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2], image.alpha[i]});
  }
  return rgba;
}

}  // namespace

Result<void> write_png(const std::filesystem::path& file, const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = image.alpha.empty() ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  const std::vector<std::uint8_t> pixels = image.alpha.empty() ? image.rgb : with_alpha(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels.data(), 0, nullptr))
    return Error{ErrorCode::unwritable, file.string() + ": the picture cannot be made into a PNG (" +
                                            header.message + "); choose another size."};
  bytes.resize(size);
  return write_file(file, bytes);
}

}  // namespace patchlab::viewer
