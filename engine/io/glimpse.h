// A first look at a scan whose file takes a while to read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/io/read_scan.h"

namespace patchlab {

struct GlimpseSize {
  std::uint64_t points = 100'000;            // about so many of them
  std::uint64_t of_bytes = 16 * (1U << 20);  // of smaller files there is none: they are read in a moment
};

// Points from all over the file, read without what lies between them, by the reader of its format. Plain, not
// organised, without notices. Nothing where points cannot be left out (compressed, pictures, meshes of text)
// or where anything is wrong: read_scan says what. Source: the file with most of its records left out.
std::optional<Scan> glimpse_scan(const std::filesystem::path& file, const ReadOptions& options = {},
                                 const GlimpseSize& size = {});

}  // namespace patchlab
