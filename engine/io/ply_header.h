// The text header of a PLY file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/io/columns.h"

namespace patchlab {

struct PlyProperty {
  std::string name;
  Scalar type = Scalar::float32;    // of the value, or of each entry of a list
  std::optional<Scalar> list_size;  // the type of the number before a list; absent: one value
};

struct PlyElement {
  std::string name;  // vertex, face, camera ...
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_list() const;
  std::size_t smallest_bytes() const;  // of one binary record: all of it, but for the entries of lists
};

struct PlyHeader {
  std::string encoding;  // ascii, binary_little_endian or binary_big_endian
  std::vector<PlyElement> elements;
  std::size_t data_begin = 0;  // byte of the file where the first element begins
  std::size_t data_line = 1;   // the line that byte is in
};

// Version 1.0. unreadable error with the line at fault. No two elements and no two properties of one share a
// name. The claims of the header are not yet held against the bytes that follow it.
Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name);

}  // namespace patchlab
