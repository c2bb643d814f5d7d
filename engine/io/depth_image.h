// Pictures that hold depths.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/io/read_scan.h"

namespace patchlab {

struct DepthImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t> samples;  // row by row; 0: no return
};

bool is_png(std::string_view bytes);
bool is_pgm(std::string_view bytes);

// unreadable error for a damaged picture, and for one that is not grey with 16 bits a pixel.
Result<DepthImage> decode_png(std::string_view bytes, const std::string& name, const ReadOptions& options);
Result<DepthImage> decode_pgm(std::string_view bytes, const std::string& name, const ReadOptions& options);

// Before the samples are allocated: are these the sides of a picture that `bytes` bytes can hold, `expansion`
// times compressed at most, within the memory limit?
Result<void> check_sides(const std::string& name, std::uint64_t width, std::uint64_t height,
                         std::uint64_t bytes, std::uint64_t expansion, const ReadOptions& options);

}  // namespace patchlab
