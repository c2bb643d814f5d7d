// The elements of a PLY file, one after another.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/io/ply_header.h"
#include "engine/io/read_scan.h"
#include "engine/io/text_numbers.h"

namespace patchlab {

// Where a reader of PLY stands in what follows the header; a record is one vertex, one face ...
class PlyCursor {
 public:
  // The bytes of the file, the header and the name must outlive the cursor.
  PlyCursor(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : name_(name),
        is_text_(header.encoding == "ascii"),
        swapped_(header.encoding == "binary_big_endian"),
        rest_(bytes.substr(header.data_begin)),
        lines_(rest_, header.data_line) {}

  bool is_text() const { return is_text_; }
  bool swapped() const { return swapped_; }
  const std::string& name() const { return name_; }
  std::string_view rest() const { return is_text_ ? lines_.rest() : rest_; }
  void skip(std::size_t bytes) { rest_.remove_prefix(bytes); }  // binary only

  // In text a record is a line: begin_record goes to the next line that is not blank, end_record wants it
  // used up.
  Result<void> begin_record();
  // One value, in the byte order of this machine, to `to`.
  Result<void> take(const PlyProperty& property, Scalar type, char* to);
  Result<void> end_record() const;
  Error cut_off() const;

 private:
  const std::string& name_;
  bool is_text_, swapped_;
  std::string_view rest_;  // binary: what is left
  LineReader lines_;       // text
  std::string_view line_;  // text: what is left of the line
};

// One element: its plain properties as columns; of its faces only how many are damaged.
struct PlyElementData {
  std::vector<char> memory;  // where the columns lie, unless in the bytes of the file
  std::vector<Column> columns;
  std::uint64_t bad_faces = 0;  // vertex_indices of fewer than three entries, or not all in [0, vertices)
};

// The lists that name vertices, as they stand: the corners of all faces, one after another, and where each
// face ends.
struct PlyFaces {
  std::vector<std::int64_t> corners;
  std::vector<std::size_t> ends;
};

// Moves the cursor behind the element; faces are kept where `faces` is not null. Every claim is held against
// the bytes that are left before anything is allocated.
Result<PlyElementData> read_ply_element(PlyCursor& cursor, const PlyElement& element, std::uint64_t vertices,
                                        const ReadOptions& options, PlyFaces* faces = nullptr);

}  // namespace patchlab
