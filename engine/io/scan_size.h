// What opening a scan will take, said before anything of it is in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace patchlab {

struct ScanSize {
  std::uint64_t points = 0;
  std::uint64_t bytes = 0;  // of memory while it is read: those of the file, and of all that is made of it
  bool exact = true;        // false: text, whose points are counted by the length of its first lines
};

// From the header and the size of the file. Nothing where that does not tell (pictures, standard input) or
// where the file cannot be read: read_scan says why.
std::optional<ScanSize> foresee_scan(const std::filesystem::path& file);

}  // namespace patchlab
