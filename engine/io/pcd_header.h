// The text header of a PCD file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/io/columns.h"
#include "engine/scan/scan.h"

namespace patchlab {

struct PcdField {
  std::string name;  // "_" is padding
  Scalar type = Scalar::float32;
  std::uint32_t count = 1;  // values a point; 0 in real files

  std::size_t bytes() const { return size_of(type) * count; }  // a point
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint32_t width = 0, height = 1;
  std::uint64_t points = 0;  // width height
  Viewpoint viewpoint;
  std::string encoding;        // ascii, binary or binary_compressed
  std::size_t data_begin = 0;  // byte of the file where the points begin
  std::size_t data_line = 1;   // the line that byte is in
  std::vector<std::string> notices;

  std::size_t point_bytes() const;   // of one point, binary
  std::size_t point_values() const;  // of one point, ascii
};

// Versions .5 to .7. unreadable error with the line at fault. The claims of the header are not yet held
// against the bytes that follow it, but points times point_bytes fits 64 bits.
Result<PcdHeader> parse_pcd_header(std::string_view bytes, const std::string& name);

}  // namespace patchlab
