#include <png.h>

#include <csetjmp>
#include <cstring>

#include "engine/io/depth_image.h"
#include "engine/io/read_error.h"

namespace patchlab {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1A\n";
constexpr std::uint64_t largest_expansion = 1100;  // deflate packs 1032 bytes into one
constexpr png_alloc_size_t largest_chunk = 8 << 20;

struct PngSource {
  std::string_view rest;
};

void take(png_structp png, png_bytep to, std::size_t size) {
  PngSource& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (size > source.rest.size()) png_error(png, "cut off");
  std::memcpy(to, source.rest.data(), size);
  source.rest.remove_prefix(size);
}

void stop(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void ignore(png_structp, png_const_charp) {}

// The reader of libpng and what it knows of the picture.
struct Decoder {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, stop, ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

// libpng leaves by longjmp, past the destructors of whatever stands in these two functions: nothing does.
bool read_header(const Decoder& decoder, PngSource& source) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_read_fn(decoder.png, &source, take);
  png_set_chunk_malloc_max(decoder.png, largest_chunk);
  png_read_info(decoder.png, decoder.info);
  return true;
}
bool read_rows(const Decoder& decoder, png_bytepp rows) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_swap(decoder.png);  // PNG is big-endian
  png_read_image(decoder.png, rows);
  png_read_end(decoder.png, nullptr);
  return true;
}

std::string kind_of(const Decoder& decoder) {
  const int colour = png_get_color_type(decoder.png, decoder.info);
  const std::string bits = std::to_string(png_get_bit_depth(decoder.png, decoder.info));
  return (colour & PNG_COLOR_MASK_COLOR ? "a colour picture of " : "a grey picture of ") + bits +
         " bits a channel" + (colour & PNG_COLOR_MASK_ALPHA ? " and transparency" : "");
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with(signature); }

Result<DepthImage> decode_png(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const Decoder decoder;
  if (decoder.info == nullptr) return unreadable(name, "there is not enough memory to read it.");
  PngSource source{bytes};
  if (!read_header(decoder, source)) return unreadable(name, "the header of the PNG picture is damaged.");
  DepthImage image{
      png_get_image_width(decoder.png, decoder.info), png_get_image_height(decoder.png, decoder.info), {}};
  if (png_get_bit_depth(decoder.png, decoder.info) != 16 ||
      png_get_color_type(decoder.png, decoder.info) != PNG_COLOR_TYPE_GRAY) {
    return unreadable(name, "is " + kind_of(decoder) + "; a depth image is grey with 16 bits.");
  }
  const auto fits = check_sides(name, image.width, image.height, bytes.size(), largest_expansion, options);
  if (!fits) return fits.error();
  image.samples.resize(std::size_t{image.width} * image.height);
  std::vector<png_bytep> rows(image.height);
  for (std::size_t row = 0; row < rows.size(); ++row)
    rows[row] = reinterpret_cast<png_bytep>(image.samples.data() + row * image.width);
  if (!read_rows(decoder, rows.data())) return unreadable(name, "the PNG picture is damaged or cut off.");
  return image;
}

}  // namespace patchlab
