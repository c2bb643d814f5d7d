// What a file is, by its first bytes.
#pragma once

#include <string>
#include <string_view>

#include "engine/io/read_scan.h"

namespace patchlab {

using ScanReader = Result<Scan> (*)(std::string_view bytes, const std::string& name,
                                    const ReadOptions& options);

// The reader of these bytes; nullptr where there is none. The ending of the name decides only where the bytes
// do not: for files without a header, and for the reader that can say what is wrong with a damaged one.
ScanReader scan_reader(std::string_view bytes, std::string_view name);

// What a file without a reader is and what to do about it: "a LAS or LAZ file; convert it with ...".
std::string what_else(std::string_view bytes);

}  // namespace patchlab
