#include "engine/io/depth_image.h"

#include "engine/io/depth_points.h"
#include "engine/io/read_error.h"
#include "engine/io/scan_from_columns.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::uint64_t largest_image_side = 1 << 15;  // px
constexpr std::string_view header_blanks = " \t\r\n";

Error not_said(const std::string& name, const std::string& what) {
  return {ErrorCode::usage, name + ": is a depth image, which does not say " + what};
}

Result<void> check_options(const std::string& name, const ReadOptions& options) {
  if (!options.intrinsics) {
    return not_said(name,
                    "what camera it is from; give --intrinsics fx,fy,cx,cy in pixels, or a file that holds "
                    "them (ROS camera_info, Open3D JSON, a 3x3 matrix), and --depth-scale.");
  }
  if (!(options.depth_scale > 0.0)) {
    return not_said(name,
                    "the unit of its depths; give --depth-scale, the raw units a metre (1000 for "
                    "millimetres, 5000 for TUM).");
  }
  if (options.unit == LengthUnit::m) return {};
  return Error{ErrorCode::usage,
               name + ": the unit of a depth image is set by --depth-scale, not by --unit."};
}

Result<void> check_fits(const std::string& name, const DepthImage& image, const Intrinsics& intrinsics) {
  const bool same = intrinsics.width == image.width && intrinsics.height == image.height;
  if (intrinsics.width == 0 || intrinsics.height == 0 || same) return {};
  return unreadable(name, "has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                              " pixels, but the intrinsics are those of pictures of " +
                              std::to_string(intrinsics.width) + " x " + std::to_string(intrinsics.height) +
                              ".");
}

// The next whole number of a PGM header; comments run from # to the end of the line.
std::optional<std::uint64_t> next_number(std::string_view& rest) {
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(header_blanks), rest.size()));
    if (!rest.starts_with('#')) break;
    rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
  }
  const std::size_t end = std::min(rest.find_first_of(header_blanks), rest.size());
  const auto number = parse_number<std::uint64_t>(rest.substr(0, end));
  rest.remove_prefix(end);
  return number;
}

}  // namespace

bool is_pgm(std::string_view bytes) {
  return bytes.size() > 2 && bytes.starts_with("P5") &&
         header_blanks.find(bytes[2]) != std::string_view::npos;
}

Result<void> check_sides(const std::string& name, std::uint64_t width, std::uint64_t height,
                         std::uint64_t bytes, std::uint64_t expansion, const ReadOptions& options) {
  if (width == 0 || height == 0 || width > largest_image_side || height > largest_image_side) {
    return unreadable(
        name, std::to_string(width) + " x " + std::to_string(height) + " are no sides of a depth image.");
  }
  if (2 * width * height > bytes * expansion) {
    return unreadable(name, std::to_string(bytes) + " bytes cannot hold " + std::to_string(width) + " x " +
                                std::to_string(height) +
                                " depths; the file is cut off or its header is wrong.");
  }
  return check_memory(name, width * height, 2 * width * height, options);
}

Result<DepthImage> decode_pgm(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  if (!is_pgm(bytes)) return unreadable(name, "is neither a PNG picture nor a binary PGM one.");
  std::string_view rest = bytes.substr(2);
  const auto width = next_number(rest), height = next_number(rest), largest = next_number(rest);
  if (!width || !height || !largest || rest.empty())
    return unreadable(
        name, "the header of a PGM picture holds width, height and the largest value; one is missing.");
  if (*largest < 256 || *largest > 65535)
    return unreadable(name, "is a PGM picture of 8 bits a pixel; a depth image has 16.");
  rest.remove_prefix(1);
  if (const auto fits = check_sides(name, *width, *height, rest.size(), 1, options); !fits)
    return fits.error();
  DepthImage image{static_cast<std::uint32_t>(*width), static_cast<std::uint32_t>(*height), {}};
  image.samples.resize(*width * *height);
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    const auto high = static_cast<unsigned char>(rest[2 * i]),
               low = static_cast<unsigned char>(rest[2 * i + 1]);
    image.samples[i] = static_cast<std::uint16_t>(high << 8 | low);
    if (image.samples[i] > *largest) {
      return unreadable(name, "holds the value " + std::to_string(image.samples[i]) +
                                  " where its header says that the largest is " + std::to_string(*largest) +
                                  "; the file is damaged, or its bytes are swapped.");
    }
  }
  return image;
}

Result<Scan> read_depth_image(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const bool png = is_png(bytes);
  const Result<DepthImage> image = png ? decode_png(bytes, name, options) : decode_pgm(bytes, name, options);
  if (!image) return image.error();
  if (const auto said = check_options(name, options); !said) return said.error();
  const Intrinsics& camera = *options.intrinsics;
  if (const auto fits = check_fits(name, *image, camera); !fits) return fits.error();
  Scan scan;
  scan.file = name;
  scan.format = png ? "png" : "pgm";
  scan.encoding = "binary";
  scan.fields = {{"depth", "uint16", 1}};
  scan.width = image->width;
  scan.height = image->height;
  scan.viewpoint.stated = true;  // the points are in the frame of their camera
  scan.intrinsics = {camera.fx, camera.fy, camera.cx, camera.cy};
  scan.positions.resize(image->samples.size());
  scan.finite.resize(image->samples.size());
  scan.finite_count = unproject({image->samples, image->width, camera, options.depth_scale},
                                scan.positions.data(), scan.finite.data());
  if (scan.finite_count == 0) scan.notices.emplace_back("None of the pixels holds a depth.");
  if (camera.distorted)
    scan.notices.emplace_back("The distortion of the lens that the intrinsics state is not corrected.");
  return scan;
}

}  // namespace patchlab
