// Files: read whole with limits, written whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"

namespace patchlab {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::uint64_t default_file_limit = std::uint64_t{4}
                                                    << 30;  // bytes, where nothing else is said

// The bytes of a regular file (a directory, pipe or device is refused without opening it) of at most `limit`
// bytes. The path "-" reads standard input to its end, with the same limit. `progress` hears of a file's
// share that is read, and may cancel.
Result<Bytes> read_file(const std::filesystem::path& file, std::uint64_t limit = default_file_limit,
                        const Progress& progress = {});

// Writes a file so that it appears whole or not at all: temporary file beside it, fsync, rename, fsync of the
// folder. A link keeps pointing where it did. A device or pipe is written to as it is; the path "-" is
// standard output.
Result<void> write_file(const std::filesystem::path& file, std::string_view bytes);

// SHA-256 of the bytes as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

// The bytes as characters.
inline std::string_view as_text(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace patchlab
